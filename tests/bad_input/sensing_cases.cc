// SPDX-License-Identifier: Apache-2.0
// Settings of sensors, estimators, mapper and recovery that cannot work. Whatever command reads the
// scenario refuses them, before anything is planned or written.
#include <fstream>
#include <iterator>

#include "tests/bad_input/bad_input.h"
#include "tests/places.h"

namespace floorproof {
namespace {

const std::string kFile = "floorproof: scenario.yaml";

std::string GoodScenario() { return GoodFiles().at("scenario.yaml"); }

// The scenario has 12 lines; what is added begins with the 13th.
BadInput Added(const std::string& name, const std::string& lines, std::vector<std::string> named) {
  return {name,
          {"run", "scenario.yaml", "--out", "o"},
          {{"scenario.yaml", GoodScenario() + lines + "\n"}},
          std::move(named)};
}
// Its estimator stands in the 7th.
BadInput Estimator(const std::string& name, const std::string& value,
                   std::vector<std::string> named) {
  return {name,
          {"run", "scenario.yaml", "--out", "o"},
          {{"scenario.yaml", Replaced(GoodScenario(), "estimator: truth", "estimator: " + value)}},
          std::move(named)};
}
BadInput By(const std::string& name, std::vector<std::string> arguments, BadInput bad) {
  bad.name = name;
  bad.arguments = std::move(arguments);
  return bad;
}

// BELUGA with `from` changed, in place of the scenario's robot.
BadInput OnARobotWith(const std::string& from, const std::string& to, BadInput bad) {
  std::ifstream file(SourceFile("models/beluga.xml"));
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  bad.files["mine.xml"] = Replaced(text, from, to);
  bad.files["scenario.yaml"] =
      Replaced(bad.files["scenario.yaml"], "robot: beluga", "robot: mine.xml");
  return bad;
}

}  // namespace

std::vector<BadInput> SensingCases() {
  const std::vector<std::string> plan = {"plan", "scenario.yaml", "--out", "o"};
  const std::vector<std::string> campaign = {"campaign", "scenario.yaml", "-n", "2", "--out", "o"};
  const BadInput within = Added("LidarWithinTheBody", "sensors: {lidar: {z_m: 0.05}}",
                                {kFile + ":13: sensors.lidar.z_m = 0.05",
                                 "the robot itself is in the way of its beams", "belly"});
  BadInput one_cell =
      Estimator("MclOnAMapOfOneFreeCell", "{prior_m: 0.1, name: mcl}",
                {kFile + ":7: estimator = mcl", "needs a map of more than one free cell"});
  one_cell.files["site.yaml"] =
      "site: 1\ngrid:\n  cell_m: 2\n  rows: |\n    ###\n    #.#\n    ###\n"
      "start: {x_m: 3, y_m: 3, yaw_deg: 0}\n";
  one_cell.files["scenario.yaml"] =
      Replaced(one_cell.files["scenario.yaml"], "x_m: 1.0, y_m: 1.0", "x_m: 3.0, y_m: 3.0");
  one_cell.files["plan.csv"] = "x_m,y_m\n3,3\n3.5,3\n";

  BadInput folds = Added("", "react: {}", {kFile + ":13: react", "changes the robot's shape"});
  folds.files["plan.csv"] = "x_m,y_m,shape\n1,1,O\n1.5,1,I\n";
  folds.files["scenario.yaml"] =
      Replaced(Replaced(folds.files["scenario.yaml"], "beluga", "htetro"), "regulated_pursuit",
               "holonomic_follower");

  return {
      Added("NoBeams", "sensors: {lidar: {beams: 0}}",
            {kFile + ":13: sensors.lidar.beams = 0", "must be in [1, 3600]"}),
      Added("TooManyBeams", "sensors:\n  lidar:\n    rate_hz: 5\n    beams: 4000",
            {kFile + ":16: sensors.lidar.beams = 4000", "must be in [1, 3600]"}),
      Added("HalfABeam", "sensors: {lidar: {beams: 1.5}}",
            {kFile + ":13: sensors.lidar.beams = 1.5", "whole"}),
      Added("NegativeRangeNoise", "sensors: {lidar: {noise_m: -0.01}}",
            {kFile + ":13: sensors.lidar.noise_m = -0.01", "must be in [0, 1]"}),
      Added("NegativeShareOfNoise", "sensors: {lidar: {noise_share: -0.01}}",
            {kFile + ":13: sensors.lidar.noise_share = -0.01", "must be in [0, 1]"}),
      Added("MoreDropoutsThanBeams", "sensors: {lidar: {dropout: 1.1}}",
            {kFile + ":13: sensors.lidar.dropout = 1.1", "must be in [0, 1]"}),
      Added("NegativeTickNoise", "sensors: {encoders: {noise: -0.1}}",
            {kFile + ":13: sensors.encoders.noise = -0.1", "must be in [0, 1]"}),
      Added("NoTicks", "sensors: {encoders: {ticks: 0}}",
            {kFile + ":13: sensors.encoders.ticks = 0", "must be in [1, 1e+07]"}),
      Added("NegativeGyroNoise", "sensors: {imu: {gyro_noise_radps: -1}}",
            {kFile + ":13: sensors.imu.gyro_noise_radps = -1", "must be >= 0"}),
      Added("NegativeAccelerometerBias", "sensors: {imu: {accel_bias_mps2: -1}}",
            {kFile + ":13: sensors.imu.accel_bias_mps2 = -1", "must be >= 0"}),
      Added("ABumperThatNothingPresses", "sensors: {bumper: {force_n: 0}}",
            {kFile + ":13: sensors.bumper.force_n = 0", "must be > 0"}),
      Added("NoiseNotANumber", "sensors: {lidar: {noise_m: .nan}}",
            {kFile + ":13: sensors.lidar.noise_m = .nan"}),
      Added("UnknownSensor", "sensors: {lider: {}}",
            {kFile + ":13: sensors.lider", "unknown key; did you mean lidar?"}),
      Added("UnknownKeyOfASensor", "sensors: {cliff: {reach: 0.1}}",
            {kFile + ":13: sensors.cliff.reach", "unknown key; did you mean reach_m?"}),
      Added("SensorsAsAList", "sensors: [lidar]",
            {kFile + ":13: sensors", "must be a map of sensors"}),
      Added("SensorsAsAWord", "sensors: lidar",
            {kFile + ":13: sensors", "must be a map of sensors"}),
      Added("ASensorAsANumber", "sensors: {lidar: 90}",
            {kFile + ":13: sensors.lidar = 90", "must be a map of keys"}),
      within,
      By("LidarWithinTheBodyOfAPlan", plan, within),
      By("LidarWithinTheBodyOfACampaign", campaign, within),
      By("LidarWithinTheBodyOfAVariant", campaign,
         Added("", "matrix: {sensors.lidar.z_m: [0.4, 0.05]}",
               {kFile + ":13: sensors.lidar.z_m = 0.05", "in the way of its beams"})),
      By("LidarWithinTheBodyOfAChoice", campaign,
         Added("", "randomise: {sensors.lidar.z_m: {choice: [0.4, 0.5, 0.6, 0.05]}}",
               {kFile + ":13: sensors.lidar.z_m = 0.05", "in the way of its beams"})),
      By("LidarWithinTheBodyByTheCommandLine",
         {"plan", "scenario.yaml", "--out", "o", "--set", "sensors.lidar.z_m=0.05"},
         Added("", "", {"floorproof: --set sensors.lidar.z_m:1: sensors.lidar.z_m = 0.05"})),
      Added("LidarWithinTheBodyOnItsOwnLine", "sensors:\n  lidar:\n    beams: 30\n    z_m: 0.1",
            {kFile + ":16: sensors.lidar.z_m = 0.1", "in the way of its beams"}),
      Added("ALidarThatSeesNoFarther", "sensors:\n  lidar:\n    range_m: 0.5\n    least_m: 0.5",
            {kFile + ":16: sensors.lidar.least_m = 0.5", "must be less than range_m, 0.5"}),
      OnARobotWith(R"(<site name="lidar" pos="0 0 0.335"/>)", "",
                   Estimator("ALidarWithoutAPlace", "{name: mcl}",
                             {kFile + ":1: sensors.lidar.z_m: must be stated", "no site"})),
      // The robot's own fault, which odometry meets first: its file is named, not the scenario.
      OnARobotWith(R"("wheel_right" pos="0 -0)", R"("wheel_right" pos="0 0)",
                   Estimator("BothWheelsOnOneSide", "odometry",
                             {"floorproof: mine.xml: drive = differential", "the same y"})),
      Estimator("NoParticles", "{name: mcl, particles: 0}",
                {kFile + ":7: estimator.particles = 0", "must be in [10, 1e+06]"}),
      Estimator("NegativePrior", "{name: mcl, prior_m: -1}",
                {kFile + ":7: estimator.prior_m = -1", "must be in [0, "}),
      Estimator("MoreParticlesAtLeastThanAtMost", "{name: mcl, particles: 50, least_particles: 60}",
                {kFile + ":7: estimator.least_particles = 60", "must be at most particles, 50"}),
      Estimator("AKeyOfAnotherEstimator", "{name: odometry, particles: 500}",
                {kFile + ":7: estimator.particles", "unknown key"}),
      one_cell,
      By("MclOnAMapOfOneFreeCellToPlan", plan, one_cell),
      By("MclOnAMapOfOneFreeCellOfACampaign", campaign, one_cell),
      Added("UnknownReaction", "react: {then: retry}",
            {kFile + ":13: react.then = retry", "must be one of replan, go_on"}),
      Added("BacksOffByNothing", "react: {back_off_m: 0}",
            {kFile + ":13: react.back_off_m = 0", "must be in [0.01, 2]"}),
      Added("BacksOffAtNoSpeed", "react: {back_off_mps: 0}",
            {kFile + ":13: react.back_off_mps = 0", "must be > 0"}),
      Added("ReactAsAWord", "react: true", {kFile + ":13: react = true", "must be a map of keys"}),
      Added("UnknownKeyOfTheReaction", "react: {cliffs: true}",
            {kFile + ":13: react.cliffs", "unknown key; did you mean cliff?"}),
      By("ReactsWhileItFolds", plan, folds),
      Added("MapperOfNoCells", "mapper: {cell_m: 0}",
            {kFile + ":13: mapper.cell_m = 0", "must be in [0.01, 1]"}),
      Added("MapperAsAList", "mapper: [0.05]", {kFile + ":13: mapper", "must be a map of keys"}),
      Added("UnknownKeyOfTheMapper", "mapper: {cells_m: 0.1}",
            {kFile + ":13: mapper.cells_m", "unknown key; did you mean cell_m?"}),
  };
}

}  // namespace floorproof
