// SPDX-License-Identifier: Apache-2.0
// Measured limits in a robot's MJCF: what is written stands in one block, all else stays, and what
// was measured of another model is not used.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>

#include "env/scene/measured_block.h"
#include "env/scene/measured_names.h"
#include "env/scene/robot_model.h"
#include "env/scene/roller_wheels.h"
#include "tests/map/temp_folder.h"
#include "tests/places.h"
#include "tests/slurp.h"

namespace floorproof {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

namespace fs = std::filesystem;

constexpr const char* kText =
    "<!-- mine </custom> -->\n<mujoco>\n  <custom>\n    <text name=\"a\" data=\"b\"/> <!-- so -->\n"
    "  </custom>\n\n  <worldbody/>\n</mujoco>\n";

TEST(MeasuredBlock, GoesToTheEndOfCustomAndComesOutAgain) {
  const std::string dut = WithMeasured(kText, "<one/>\n<two/>\n", "a.xml");
  EXPECT_THAT(dut, HasSubstr("<!-- so -->\n    <!-- Measured by floorproof robot"));
  EXPECT_THAT(dut, HasSubstr("-->\n    <one/>\n    <two/>\n    <!-- End of what was measured. -->"
                             "\n  </custom>\n\n"));
  EXPECT_EQ(WithoutMeasured(dut), kText) << "byte for byte";
  EXPECT_EQ(WithMeasured(dut, "<one/>\n<two/>\n", "a.xml"), dut);
  const std::string other = WithMeasured(dut, "<three/>\n", "a.xml");
  EXPECT_THAT(other, Not(HasSubstr("<one/>")));
  EXPECT_EQ(other, WithMeasured(kText, "<three/>\n", "a.xml")) << "one block, replaced";
}

TEST(MeasuredBlock, KeepsLineBreaksAndWhateverElseThereIs) {
  EXPECT_EQ(WithoutMeasured(kText), kText);
  std::string dos(kText);
  for (std::size_t at = 0; (at = dos.find('\n', at)) != dos.npos; at += 2) dos.insert(at, "\r");
  const std::string measured = WithMeasured(dos, "<one/>\n", "a.xml");
  EXPECT_THAT(measured, HasSubstr("    <one/>\r\n"));
  EXPECT_EQ(WithoutMeasured(measured), dos);
  // Without a <custom>, and all on one line.
  for (const std::string dut :
       {"<mujoco><include file=\"b.xml\"/></mujoco>",
        "<mujoco>\n<custom><text name=\"a\" data=\"b\"/></custom></mujoco>"}) {
    const std::string own = WithMeasured(dut, "<one/>\n", "a.xml");
    EXPECT_EQ(WithoutMeasured(own), dut);
    EXPECT_EQ(WithMeasured(own, "<one/>\n", "a.xml"), own);
    EXPECT_THAT(own, HasSubstr("<custom>"));
  }
  EXPECT_THROW(WithMeasured("<robot/>", "<one/>\n", "a.xml"), InputError);
}

// Whatever wrote the file again without its comments: a second block would repeat every name.
TEST(MeasuredBlock, OneThatLostACommentIsRefused) {
  const std::string dut = WithMeasured(kText, "<text name=\"measured_by\" data=\"x\"/>\n", "a.xml");
  for (const char* lost : {"<!-- Measured by", "<!-- End of what"}) {
    std::string text = dut;
    const std::size_t at = text.find(lost);
    text.erase(at, text.find("-->", at) + 3 - at);
    EXPECT_THROW(WithMeasured(text, "<one/>\n", "a.xml"), InputError) << lost;
  }
}

class MeasuredRobot : public TempFolder {
 protected:
  // BELUGA with limits: steps of 10 mm at 0.1 m/s and 20 mm at 0.2 m/s forward, less at 45 degrees.
  fs::path Measured(const std::string& lines = "") const {
    const fs::path file = Save("mine.xml", Slurp(SourceFile("models/beluga.xml")));
    const std::string elements =
        "<text name=\"measured_by\" data=\"a test\"/>\n<text name=\"measured_model\" data=\"" +
        ModelHash(std::vector<fs::path>{file}, {}) +
        "\"/>\n<numeric name=\"measured_frictions\" data=\"0.4 0.8\"/>\n"
        "<numeric name=\"measured_speeds_mps\" data=\"0.1 0.2\"/>\n"
        "<numeric name=\"measured_step_forward_mm\" data=\"5 6 10 20\"/>\n"
        "<numeric name=\"measured_step_diagonal_mm\" data=\"6 5.5 9 8\"/>\n"
        "<numeric name=\"measured_cable_cover_height_forward_mm\" data=\"0 5 -60.2 30\"/>\n"
        "<numeric name=\"measured_ramp_down_forward_deg\" data=\"-45 -45 -45 -45\"/>\n" +
        lines;
    return Save("mine.xml", WithMeasured(Slurp(file), elements, file));
  }
};

TEST_F(MeasuredRobot, IsReadWithItsWorstLimits) {
  const fs::path file = Measured();
  const MeasuredLimits dut = ReadRobot(file).spec.measured;
  EXPECT_EQ(dut.why_unused, "");
  EXPECT_EQ(dut.by, "a test");
  EXPECT_NEAR(*LimitOn(dut, "step", 0.4), 0.005, 1e-12);
  EXPECT_NEAR(*LimitOn(dut, "step", 0.8), 0.008, 1e-12) << "at 45 degrees and 0.2 m/s";
  EXPECT_EQ(*LimitOn(dut, "cable_cover_height", 0.4), 0);
  EXPECT_NEAR(*LimitOn(dut, "cable_cover_height", 0.8), 0.030, 1e-12);
  EXPECT_NEAR(*LimitOn(dut, "ramp_down", 0.8), kPi / 4, 1e-12) << "more was not tried";
  EXPECT_EQ(LimitOn(dut, "groove", 0.8), std::nullopt);
  EXPECT_NEAR(ReadRobot(file).spec.step_m, 0.010, 1e-12) << "what its model trusts it with stays";
}

TEST_F(MeasuredRobot, OfAnotherModelTheyAreNotUsed) {
  const fs::path file = Measured();
  std::string text = Slurp(file);
  const auto replace = [&](const std::string& from, const std::string& to) {
    ASSERT_NE(text.find(from), text.npos);
    text.replace(text.find(from), from.size(), to);
    std::ofstream(file, std::ios::binary) << text;
  };
  replace("<worldbody>", "<!-- looked at -->\n\n   <worldbody>");
  EXPECT_EQ(ReadRobot(file).spec.measured.why_unused, "") << "comments and spaces say nothing";
  EXPECT_EQ(ReadRobot(file, {.battery_v = 12.0}).spec.measured.why_unused, "") << "it has 12 V";
  // As init's scenarios draw them: BELUGA has 12.16 kg and 12 V.
  for (const RobotChanges& changes :
       {RobotChanges{.mass_kg = 11.0}, RobotChanges{.mass_kg = 13.3},
        RobotChanges{.battery_v = 10.8}, RobotChanges{.battery_v = 13.1}})
    EXPECT_EQ(ReadRobot(file, changes).spec.measured.why_unused, "");
  const std::pair<RobotChanges, const char*> others[] = {
      {{.mass_kg = 13.5}, "its mass by more than a tenth"},
      {{.mass_kg = 10.8}, "its mass by more than a tenth"},
      {{.clearance_m = 0.0249}, "its clearance"},
      {{.wheel_radius_m = 0.0499}, "its wheels"},
      {{.battery_v = 10.7}, "its battery's voltage by more than a tenth"}};
  for (const auto& [changes, why] : others) {
    const MeasuredLimits dut = ReadRobot(file, changes).spec.measured;
    EXPECT_EQ(dut.why_unused, std::string("the scenario changes ") + why);
    EXPECT_TRUE(dut.limits.empty());
  }
  replace("mass=\"0.45\"", "mass=\"0.46\"");
  EXPECT_EQ(ReadRobot(file).spec.measured.why_unused, "the model was changed since");
  EXPECT_TRUE(ReadRobot(file).spec.measured.limits.empty());
}

TEST_F(MeasuredRobot, ThatIsWrittenWrongIsRefused) {
  const auto refusal = [&](const std::string& line) {
    return Refusal([&] { ReadRobot(Measured(line + "\n")); });
  };
  EXPECT_THAT(refusal("<numeric name=\"measured_drop_forward_mm\" data=\"1 2 3\"/>"),
              HasSubstr("mine.xml: measured_drop_forward_mm: must have one number a friction and "
                        "speed, 4"));
  const auto limit = [&](const std::string& name, const std::string& data = "1 2 3 4") {
    return refusal("<numeric name=\"measured_" + name + "\" data=\"" + data + "\"/>");
  };
  EXPECT_EQ(limit("drop_forward_mm"), "accepted")
      << "or nothing below is of the fault that it names";
  EXPECT_THAT(limit("drop_forward_ft"), HasSubstr("mine.xml: measured_drop_forward_ft = ft: must "
                                                  "be mm, the unit of drop"));
  EXPECT_THAT(limit("drop_forward_deg"), HasSubstr("= deg: must be mm"));
  EXPECT_THAT(limit("wet_forward_mm"), HasSubstr("= mm: must be pct"));
  EXPECT_THAT(limit("dorp_forward_mm"),
              HasSubstr("measured_dorp_forward_mm = dorp: unknown kind of hazard; did you mean "
                        "drop? (known: step drop "));
  EXPECT_THAT(limit("drop_forwards_mm"),
              HasSubstr("= forwards: unknown direction; did you mean forward?"));
  for (const char* name : {"mm", "forward_mm", "_forward_mm", "drop", ""})
    EXPECT_THAT(limit(name), HasSubstr("must be measured_KIND_DIRECTION_UNIT")) << name;
  EXPECT_THAT(limit("drop_forward_mm", "1 2 2001 4"), HasSubstr("= 2001: must be in"));
  EXPECT_THAT(limit("ramp_forward_deg", "1 2 -91 4"), HasSubstr("= -91: must be in [-90, 90]"));
  for (const char* number : {"inf", "nan"})
    EXPECT_THAT(
        limit("drop_forward_mm", "1 2 " + std::string(number) + " 4"),
        HasSubstr("numeric 'measured_drop_forward_mm' data = " + std::string(number) + ": must be"))
        << number;
  EXPECT_THAT(limit("step_forward_mm"), HasSubstr("measured_step_forward_mm")) << "a second one";
  EXPECT_THAT(refusal("<text name=\"measured_drop_forward_mm\" data=\"1 2 3 4\"/>"),
              HasSubstr("measured_drop_forward_mm: unknown text of what was measured"));
}

TEST_F(MeasuredRobot, ThatLostWhoMeasuredItIsRefused) {
  const fs::path file = Measured();
  std::string text = Slurp(file);
  const auto without = [&](const std::string& name) {
    const std::size_t at = text.rfind('<', text.find("name=\"measured_" + name + '"'));
    text.erase(at, text.find("/>", at) + 2 - at);
    return Refusal([&] { ReadRobot(Save("mine.xml", text)); });
  };
  EXPECT_THAT(without("by"), AllOf(HasSubstr("mine.xml: measured_by: missing under <custom>"),
                                   HasSubstr("--ladder` writes it anew")));
  // Whatever of the block is left says that there was one.
  for (const char* name : {"model", "frictions", "speeds_mps", "step_forward_mm",
                           "step_diagonal_mm", "cable_cover_height_forward_mm"})
    EXPECT_THAT(without(name), HasSubstr("measured_by: missing")) << name;
  EXPECT_EQ(without("ramp_down_forward_deg"), "accepted") << "nothing is left";
}

// The block states its figures' hash: whoever edits one is told, and the limits are not used.
TEST_F(MeasuredRobot, AnEditedFigureIsTold) {
  const std::map<std::string, std::string> said = {
      {"measured_by", "a test"},
      {"measured_model",
       ModelHash(std::vector<fs::path>{Save("mine.xml", Slurp(SourceFile("models/beluga.xml")))},
                 {})},
      {"measured_frictions", "0.4 0.8"},
      {"measured_speeds_mps", "0.1 0.2"},
      {"measured_step_forward_mm", "5 6 10 20"},
      {"measured_step_diagonal_mm", "6 5.5 9 8"},
      {"measured_cable_cover_height_forward_mm", "0 5 -60.2 30"},
      {"measured_ramp_down_forward_deg", "-45 -45 -45 -45"}};
  const std::string hash = "<text name=\"measured_figures\" data=\"" + FiguresHash(said) + "\"/>\n";
  const MeasuredLimits as_measured = ReadRobot(Measured(hash)).spec.measured;
  EXPECT_EQ(as_measured.why_unused, "");
  EXPECT_TRUE(as_measured.hashed);
  EXPECT_FALSE(ReadRobot(Measured()).spec.measured.hashed) << "of an older version";
  const std::string whole = Slurp(Measured(hash));
  const auto edited = [&](const std::string& from, const std::string& to) {
    std::string text = whole;
    EXPECT_NE(text.find(from), text.npos) << from;
    return ReadRobot(Save("mine.xml", text.replace(text.find(from), from.size(), to)))
        .spec.measured;
  };
  EXPECT_EQ(edited("\"5 6 10 20\"", "\"5.0   6 1e1 20\"").why_unused, "") << "the same figures";
  for (const auto& [from, to] : std::vector<std::pair<std::string, std::string>>{
           {"\"5 6 10 20\"", "\"5 6 10 20.001\""},
           {"-60.2", "60.2"},
           {"step_diagonal", "step_oblique"},
           {"\"0.4 0.8\"", "\"0.3 0.8\""},
           {"\"0.1 0.2\"", "\"0.1 0.3\""},
           {"a test", "another"},
           {"<numeric name=\"measured_step_diagonal_mm\" data=\"6 5.5 9 8\"/>", ""}}) {
    const MeasuredLimits dut = edited(from, to);
    EXPECT_EQ(dut.why_unused, "they were edited since") << from;
    EXPECT_TRUE(dut.limits.empty());
  }
}

// A reconfigurable robot's limits are of the shape that was measured, and of ideal wheels.
TEST_F(MeasuredRobot, HasOneShapeAndOneKindOfWheels) {
  const fs::path file = Save("mine.xml", Slurp(SourceFile("models/htetro.xml")));
  Save("mine.xml", WithMeasured(Slurp(file),
                                "<text name=\"measured_by\" data=\"a test\"/>\n"
                                "<text name=\"measured_model\" data=\"" +
                                    ModelHash(std::vector<fs::path>{file}, {}) +
                                    "\"/>\n<numeric name=\"measured_frictions\" data=\"0.8\"/>\n"
                                    "<numeric name=\"measured_speeds_mps\" data=\"0.2\"/>\n"
                                    "<numeric name=\"measured_step_forward_mm\" data=\"5\"/>\n",
                                file));
  const RobotModel square = ReadRobot(file);
  EXPECT_FALSE(square.spec.measured.limits.empty());
  EXPECT_FALSE(ReadRobot(file, {}, Blocks::kHinged).spec.measured.limits.empty());
  ASSERT_GT(square.spec.shapes.size(), 1u);
  EXPECT_TRUE(ReadRobot(file, {.shape = square.spec.shapes[1].name}).spec.measured.limits.empty());
  EXPECT_EQ(WithRollerWheels(square).spec.measured.why_unused, "they are of ideal wheels");
}

}  // namespace
}  // namespace floorproof
