// SPDX-License-Identifier: Apache-2.0
#include "run/scenario/risk_model_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.h"
#include "measure/fit_rates.h"
#include "measure/risk_model_json.h"
#include "planners/risk/rate_evaluator.h"
#include "tests/measure/planted_rates.h"

namespace floorproof {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Two kinds with rates, one without.
RiskModel Measured(int covers) {
  Stream random(1, 0, "risk_model_file_test");
  std::vector<Encounter> met = DrawEncounters(covers, GradualCover, DrawCover, random);
  for (int i = 0; i < 90; ++i) {
    met.push_back(met[i]);
    met.back().type = i < 80 ? "step" : "groove";
    met.back().passage = Passage::kBeside;
  }
  RateFitOptions options;
  options.mirrored = true;
  return FitRates(met, {"cart", "differential", 12.3, 0.02, "abc"}, options);
}

RiskModel Read(const std::string& text) {
  InputFiles files;
  files.Hold("risk_model.json", text);
  return *ReadRiskModel("risk_model.json", files);
}

std::string WhyRefused(const std::string& text) {
  try {
    Read(text);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string With(std::string text, const std::string& old, const std::string& now) {
  const std::size_t at = text.find(old);
  EXPECT_NE(at, std::string::npos) << old;
  if (at != std::string::npos) text.replace(at, old.size(), now);
  return text;
}

TEST(RiskModelFile, ReadsBackWhatWasWritten) {
  const RiskModel model = Measured(250);
  const std::string text = RiskModelJson(model);
  const RiskModel dut = Read(text);
  EXPECT_EQ(RiskModelJson(dut), text);
  EXPECT_EQ(dut.robot.name, "cart");
  EXPECT_TRUE(dut.mirrored);
  ASSERT_EQ(dut.kinds.size(), 2u);
  ASSERT_EQ(dut.unmeasured.size(), 1u);
  EXPECT_EQ(dut.unmeasured[0].why, model.unmeasured[0].why);
  // Number by number, so predictions are the same to the bit.
  Stream random(2, 0, "risk_model_file_test");
  for (std::size_t k = 0; k < 2; ++k) {
    const RateEvaluator of_file(dut.kinds[k]), of_memory(model.kinds[k]);
    for (int i = 0; i < 20; ++i) {
      const Encounter e = DrawCover(random);
      Covariates covariates(dut.kinds[k].axes, true, e.size);
      const std::span<const double> x = covariates.Of(e.at);
      EXPECT_EQ(of_file.At(x), of_memory.At(x));
      EXPECT_EQ(of_file.MembersAt(x), of_memory.MembersAt(x));
    }
  }
}

TEST(RiskModelFile, HoldsWhatPlansSaid) {
  RiskModel model = Measured(90);
  EXPECT_THAT(RiskModelJson(model), Not(HasSubstr("\"plans\""))) << "nothing was learned";
  EXPECT_EQ(Read(RiskModelJson(model)).carry_over.Of(0.3), 0.3);
  model.carry_over = {-0.5, 1.25, 80, 320, 40, 52.5};
  const std::string text = RiskModelJson(model);
  const RiskModel dut = Read(text);
  EXPECT_EQ(RiskModelJson(dut), text);
  EXPECT_EQ(dut.carry_over.Of(0.3), model.carry_over.Of(0.3));
  EXPECT_LT(dut.carry_over.Of(0.3), 0.2);
  EXPECT_THAT(WhyRefused(With(text, "\"slope\": 1.25", "\"slope\": -1")),
              HasSubstr("plans.slope = -1: must be > 0"));
  EXPECT_THAT(WhyRefused(With(text, "\"failed\": 40", "\"failed\": 400")),
              HasSubstr("plans.failed = 400: must be at most the drives, 320"));
}

TEST(RiskModelFile, SaysWhatIsWrongAndWhere) {
  const std::string text = RiskModelJson(Measured(90));
  struct Case {
    const char *old, *now, *says;
  };
  for (const Case& c : {
           Case{"\"risk_model\": 3", "\"risk_model\": 2",
                "risk_model.json:2: risk_model = 2: must be 3: another version of floorproof"},
           Case{"\"risk_model\": 3", "\"fmea\": 3", "risk_model: the key is missing"},
           Case{"\"mirrored\": true,\n", "", "mirrored: the key is missing"},
           Case{"\"mirrored\"", "\"mirored\"", "mirored: unknown key; did you mean mirrored?"},
           Case{"\"passage\": \"over\"", "\"passage\": \"under\"",
                "kinds.0.passage = under: must be one of over, beside"},
           Case{"\"manner\": \"any\"", "\"manner\": \"rolling\"",
                "kinds.0.manner = rolling: must be one of any, straight, turning"},
           Case{"\"censored\": 0", "\"censored\": -1", "kinds.0.censored = -1: must be in [0,"},
           Case{"\"censored\": 0", "\"censored\": 3", "kinds.0.encounters = 90: must be cleared"},
           Case{"\"name\": \"speed_mps\"", "\"name\": \"pace\"",
                "= pace: is no column of an approach"},
           Case{"\"name\": \"friction\"", "\"name\": \"speed_mps\"",
                ".name = speed_mps: must stand there once"},
           Case{"\"coefficients\": [", "\"coefficients\": [1, ", "must be a list of"},
           Case{"\"way_m\": 0.0", "\"way_m\": -2.0", "kinds.0.way_m = -2.0: must be >= 0"},
           Case{"\"blocks\": []", "\"blocks\": [[99, 0, 1]]", "blocks = 99: must be in [0,"},
           Case{"\"members\": [", "\"members\": [[1], ", "must be 16 lists"},
           Case{"\"mode\": \"stuck\"", "\"mode\": \"lost\"",
                "mode = lost: must be one of veer_off, stuck, roll_over, bounce_back"},
           Case{"\"mode\": \"stuck\"", "\"mode\": \"veer_off\"",
                "mode = veer_off: must be split off once"},
           Case{"\"mode\": \"stuck\",\n     \"events\": ",
                "\"mode\": \"stuck\",\n     \"events\": 9", "must be at most the failures left"},
           Case{"\"splits\": [", "\"splits\": [{}, ", "kinds.0.splits: must be 3 maps"},
           Case{"\"mass_kg\": 12.3", "\"mass_kg\": -1", "robot.mass_kg = -1: must be >= 0"},
           Case{"\"mass_kg\": 12.3", "\"mass_kg\": \"heavy\"", "robot.mass_kg"},
           Case{"\"type\": \"step\",\n   \"passage\": \"beside\"",
                "\"type\": \"cable_cover\",\n   \"passage\": \"over\"",
                "cable_cover over: must stand there once"},
       }) {
    const std::string why = WhyRefused(With(text, c.old, c.now));
    EXPECT_THAT(why, HasSubstr("risk_model.json:"));
    EXPECT_THAT(why, HasSubstr(c.says));
    EXPECT_THAT(why, Not(HasSubstr("\n")));
  }
  EXPECT_THAT(WhyRefused("[1, 2]"), HasSubstr("must be a map of keys"));
  EXPECT_THAT(WhyRefused(text.substr(0, text.size() / 2)), HasSubstr("risk_model.json:"));
  RiskModel empty = Measured(90);
  empty.kinds.clear();
  EXPECT_THAT(WhyRefused(RiskModelJson(empty)), HasSubstr("kinds: must not be empty"));
}

}  // namespace
}  // namespace floorproof
