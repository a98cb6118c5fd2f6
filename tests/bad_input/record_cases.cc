// SPDX-License-Identifier: Apache-2.0
// JSON files under the names of a command's results: damaged, of another kind, or of another
// program. The line names file and key and quotes nothing of the file.
#include "tests/bad_input/bad_input.h"

namespace floorproof {
namespace {

const std::string kSecret = "\"secret\": \"hunter2\"";
const std::string kResult =
    R"({"outcome": "success", "events": [], "metrics": {"duration_s": 2.5}, "seed": 3})";
const std::string kSummary = R"({"campaign": "c", "unfinished": null, "variants": {"a": {}},
"gate": null, "versions": {}, "episodes": 1})";
const std::string kEvent =
    R"([{"mode": "stuck", "kind": "", "t_s": 1, "x_m": 2, "y_m": 3, "text": ""}])";

BadInput Report(const std::string& name, const std::string& file, const std::string& content,
                std::vector<std::string> named) {
  named.insert(named.begin(), file + ": ");
  return {name, {"report", "."}, {{file, content}}, std::move(named)};
}
BadInput Result(const std::string& name, const std::string& from, const std::string& to,
                std::vector<std::string> named) {
  return Report("ResultWith" + name, "result.json", Replaced(kResult, from, to), std::move(named));
}
BadInput Compared(const std::string& name, const std::string& content,
                  std::vector<std::string> named) {
  named.insert(named.begin(), "summary.json: ");
  return {"SummaryWith" + name, {"report", "."}, {{"summary.json", content}}, std::move(named)};
}

}  // namespace

std::vector<BadInput> RecordCases() {
  const std::string deep = "{\"a\": " + std::string(100'000, '[') + std::string(100'000, ']') + "}";
  return {
      Report("ResultThatIsText", "result.json", "user " + kSecret,
             {"is not a result (a JSON object): it is no JSON\n"}),
      Report("ResultThatIsDeep", "result.json", deep, {"nested more than 100 levels deep"}),
      Report("ResultOfAnotherKind", "result.json", "{" + kSecret + "}",
             {"events: is missing: damaged, or of another version"}),
      Result("OutcomeAsANumber", "\"success\"", "1", {"outcome: must be text"}),
      Result("EventsAsText", "[]", "\"none\"", {"events: must be a list"}),
      Result("AnEventOfText", "[]", "[\"fell\"]", {"events.0: must be an object"}),
      Result("AnEventAtNoTime", "[]", Replaced(kEvent, "\"t_s\": 1", "\"t_s\": \"early\""),
             {"events.0.t_s: must be a number"}),
      Result("AnEventOfNoMode", "[]", Replaced(kEvent, "\"mode\": \"stuck\", ", ""),
             {"events.0.mode: is missing"}),
      Result("MetricsAsAList", "{\"duration_s\": 2.5}", "[1]", {"metrics: must be an object"}),
      Result("AMetricAsText", "2.5", "\"long\"", {"metrics.duration_s: must be a number"}),
      Result("MarginsAsText", "\"seed\": 3", "\"margins\": \"wide\"",
             {"margins: must be an object"}),
      Result("AVersionAsANumber", "\"seed\": 3", "\"versions\": {\"mujoco\": 3}",
             {"versions.mujoco: must be text"}),
      Result("ASeedBeyondIntegers", "\"seed\": 3", "\"seed\": 18446744073709551615",
             {"seed: is out of range"}),
      Result("DrawsAsText", "\"seed\": 3", "\"drawn\": \"none\"", {"drawn: must be an object"}),
      {"ReplayOfAnotherKind",
       {"replay", "."},
       {{"scenario.resolved.yaml", GoodFiles().at("drawn.yaml")}, {"result.json", "{}"}},
       {"result.json: outcome: is missing"}},
      Compared("Text", kSecret, {"is not a campaign's summary (a JSON object): it is no JSON\n"}),
      Compared("ASecret", "{" + kSecret + "}", {"campaign: is missing"}),
      Compared("AVariantWithoutKeys", kSummary, {"variants.a.n: is missing"}),
      Compared("ACountAsText", Replaced(kSummary, "{}", R"({"n": "many"})"),
               {"variants.a.n: must be a whole number"}),
      Compared("AHugeCount", Replaced(kSummary, "{}", R"({"n": 1e300})"),
               {"variants.a.n: must be a whole number"}),
      Report("RareThatIsText", "rare.json", kSecret, {"is not an answer of floorproof rare"}),
      Report("RareOfAnotherVersion", "rare.json", "{\"rare\": 2}", {"rare: must be 1"}),
      Report("RareWithoutItsAnswer", "rare.json", "{\"rare\": 1}", {"probability: is missing"}),
      Report("RareWithAnImpossibleProbability", "rare.json",
             R"({"rare": 1, "probability": 2, "lower": 0.1, "upper": 0.2,
                 "without_sampler": {"lower": 0, "upper": 0.5}})",
             {"probability: must be a probability: in (0, 1]"}),
      {"FilmTimesThatAreText",
       {"report", "."},
       {{"result.json", kResult}, {"video.mp4", "film"}, {"video.json", kSecret}},
       {"video.json: is not a film's times"}},
      {"FilmTimesInWords",
       {"report", "."},
       {{"result.json", kResult},
        {"video.mp4", "film"},
        {"video.json", R"({"fps": 25, "t_s": ["early"]})"}},
       {"video.json: t_s.0: must be a number"}},
  };
}

}  // namespace floorproof
