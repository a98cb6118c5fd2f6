// SPDX-License-Identifier: Apache-2.0
#include "env/urdf/urdf_mjcf.h"

#include <string_view>

#include "base/error.h"
#include "base/try_in_child.h"
#include "env/urdf/mjcf_writer.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

// An answer of the child: kRefused and why, or kTaken, the notes, what is wrong, and the MJCF. A
// list ends with an empty text; no text holds a 0.
constexpr char kRefused = 'r', kTaken = 't', kEnd = '\0';

std::string Answer(const fs::path& file, const UrdfAnswers& answers, const ChooseDrive& choose,
                   const InputFiles& files) {
  try {
    const UrdfRobot robot = FindRobotParts(file, ReadUrdfModel(file, files), answers, choose);
    const RobotGuesses guesses = GuessRobot(robot, answers);
    std::string answer(1, kTaken);
    for (const std::string& note : robot.notes) answer += note + kEnd;
    for (const std::string& question : Questions(guesses)) answer += question + kEnd;
    answer += kEnd;
    for (const std::string& wrong : robot.wrong) answer += wrong + kEnd;
    return answer + kEnd + WriteMjcf(robot, guesses, answers, file.filename().string());
  } catch (const InputError& e) {
    return kRefused + std::string(e.what());
  } catch (const InternalError& e) {
    return kRefused + file.string() + ": MuJoCo does not take it: " + e.what();
  }
}

}  // namespace

UrdfMjcf MjcfOfUrdf(const fs::path& file, const UrdfAnswers& answers, const ChooseDrive& choose,
                    const InputFiles& files) {
  const TrialOutcome outcome = TryInChild([&] { return Answer(file, answers, choose, files); });
  if (!outcome.answer)
    throw InputError({file.string(), 0}, "", "",
                     "MuJoCo " + outcome.failure + " while it read this robot");
  const std::string& answer = *outcome.answer;
  if (answer.starts_with(kRefused)) throw InputError(answer.substr(1));
  UrdfMjcf out;
  std::size_t at = 1;
  for (std::vector<std::string>* list : {&out.notes, &out.wrong}) {
    for (std::size_t end; (end = answer.find(kEnd, at)) > at; at = end + 1)
      list->push_back(answer.substr(at, end - at));
    ++at;
  }
  out.text = answer.substr(at);
  return out;
}

}  // namespace floorproof
