// SPDX-License-Identifier: Apache-2.0
#include "tests/hostile/secret_files.h"

namespace floorproof {

std::map<std::string, std::string> SecretFiles() {
  using namespace std::string_literals;
  const std::string& s = kSecret;
  return {{"environ", "HOME=/root\0TOKEN="s + s + "\0"s},
          {"assignment", "TOKEN=" + s + "\nx\n"},
          {"bare", s + "\n"},
          {"yaml", "token: " + s + "\nother: 1\n"},
          {"yaml_key", s + ": 1\nother: 2\n"},
          {"yaml_twice", s + ": 1\n" + s + ": 2\n"},
          {"yaml_list", "- " + s + "\n- b\n"},
          {"yaml_open", "a: [b, " + s + "\n  c: {\n"},
          {"yaml_tabs", "\t" + s + ":\n\t\t- x\n"},
          {"yaml_alias", "*" + s + "\n"},
          {"yaml_tag", "a: !" + s + " b\n"},
          {"yaml_control", "a: \"" + s + "\\x1b\"\n"},
          {"yaml_quote", "\"" + s + "\n"},
          {"json", "{\"token\": \"" + s + "\"}\n"},
          {"json_open", "{\"token\": \"" + s + "\n"},
          {"csv", "user," + s + ",password\n1,2,3\n"},
          {"semicolons", s + ";a;b\n"},
          {"pgm", "P5\n# " + s + "\n" + s + " 2\n255\n"},
          {"pgm_number", "P2\n2 2\n255\n0 0 " + s + " 0\n"},
          {"xml", "<config><token value=\"" + s + "\">" + s + "</token></config>\n"},
          {"xml_open", "<config><" + s + " a=\"" + s + "\"\n"},
          {"key", "-----BEGIN PRIVATE KEY-----\n" + s + "AAAA==\n-----END PRIVATE KEY-----\n"}};
}

std::vector<std::string> ScenariosNaming() {
  const std::string version = "scenario: 1\n";
  const std::string site =
      "site: {site: 1, grid: {cell_m: 0.5, rows: \"######\\n#....#\\n#....#\\n######\\n\"}, "
      "start: {x_m: 1, y_m: 1, yaw_deg: 0}, goal: {x_m: 2, y_m: 1}}\n";
  const std::string robot = "robot: beluga\n", plan = "plan: straight\n";
  return {version + site + robot + "plan: {file: FILE}\n",
          version + site + robot + "plan: {planner: audit, samples: {file: FILE}}\n",
          version + "site: FILE\n" + robot + plan,
          version + "site: {site: 1, map: FILE}\n" + robot + plan,
          version + "site: {site: 1, map: map.yaml}\n" + robot + plan,  // whose image is the file
          version + site + "robot: ./FILE.xml\n" + plan,
          version + site + "robot: {name: ./FILE.xml}\n" + plan,
          version + site + "robot: ./names_it.xml\n" + plan,  // which includes the file
          version + site + robot + plan + "safety: {}\nmission: FILE.yaml\n",
          version + site + robot + plan + "risk: {tables: FILE.yaml}\n",
          version + site + robot + "plan: survival_coverage\nrisk: {model: FILE}\n"};
}

}  // namespace floorproof
