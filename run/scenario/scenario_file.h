// SPDX-License-Identifier: Apache-2.0
// A scenario's file, from which its episodes are read.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/config.h"
#include "base/input_files.h"
#include "run/scenario/draws.h"
#include "run/scenario/matrix.h"
#include "run/scenario/override.h"
#include "run/scenario/scenario.h"
#include "run/scenario/trust.h"

namespace floorproof {

// A scenario file with all that was read for it so far, to be read where its files are not.
struct PackedScenario {
  std::filesystem::path file;
  Trust trust = Trust::kNone;
  std::optional<std::string> text;  // none: it is the file's
  std::vector<Override> overrides;
  std::vector<std::pair<std::string, std::string>> inputs;  // name and bytes; no bundled models
};

// A scenario file in memory, from which the episodes of a campaign are read. Several threads may
// read at a time; copies share what was read.
class ScenarioFile {
 public:
  // Reads the file and applies the overrides (keys below `site.` reach into the site file); what is
  // set is not drawn. Throws InputError naming file, line, key, value and rule.
  explicit ScenarioFile(const std::filesystem::path& file,
                        const std::vector<Override>& overrides = {}, Trust trust = Trust::kNone);
  // The same of the caller's own text in memory, which is trusted and treated as the content of
  // `file`: paths in it are relative to that file's folder, messages name it, and it need not be
  // there.
  static ScenarioFile FromText(const std::string& text, const std::filesystem::path& file,
                               const std::vector<Override>& overrides = {});
  // Of a file that was packed, perhaps on another machine: packed files are read
  // from the pack, all others from this machine. Messages are those of the file that was packed.
  static ScenarioFile Unpack(const PackedScenario& packed);
  PackedScenario Pack() const;
  // Only for variants(), gate() and drives(): the files that it names may be gone, and Read() may
  // throw.
  static ScenarioFile Recorded(const std::filesystem::path& file);

  // One episode of one variant, checked whole; without an episode nothing is drawn. Throws
  // InputError.
  Scenario Read(std::optional<std::uint64_t> episode = 0, const Variant& variant = {}) const;

  // Episode `episode` as if `randomise` had drawn this for it. Throws InputError.
  Scenario ReadDrawn(std::uint64_t episode, const Drawn& drawn) const;

  // The keys of `randomise`, as written, without those that an override sets.
  const std::vector<RandomisedKey>& randomised() const { return randomised_; }
  // Whether what `randomise` draws can differ between episodes.
  bool draws_differ() const;
  // What `randomise` draws for an episode.
  Drawn DrawnOf(std::uint64_t episode) const;

  const std::filesystem::path& file() const { return file_; }
  // Every file that was read for it so far, each once: what it gives does not change with them.
  const InputFiles& files() const { return files_; }
  const std::vector<Variant>& variants() const { return variants_; }
  int seed() const { return seed_; }
  std::uint64_t episode() const { return episode_; }  // the key `episode`
  std::string name() const;                           // the key `name`, else the file's stem
  ConfigNode gate() const;                            // null: none
  bool drives() const;                                // through physics: it can fail
  // Reads each variant, and each choice of `randomise` in it, as some of the first episodes would
  // be: throws InputError where none of them makes sense (a key that is none, a robot unknown).
  void CheckDraws() const;

 private:
  enum class Files { kCheck, kMayBeGone };
  ScenarioFile(std::optional<std::string> text, const std::filesystem::path& file,
               const std::vector<Override>& overrides, Trust trust, Files files,
               InputFiles inputs = {});
  // `drawn`: of the episode; null: there is none, and nothing is drawn.
  Scenario ReadWith(std::optional<std::uint64_t> episode, const Drawn* drawn,
                    const Variant& variant, const Variant& forced) const;
  const ConfigNode& SiteTree(const std::filesystem::path& file) const;
  void ReadSitePart(const ConfigNode& root, const Variant& changes, bool episode,
                    Scenario& s) const;

  std::filesystem::path file_;
  InputFiles files_;
  std::optional<std::string> text_;  // none: the file's
  ConfigNode root_;
  std::vector<std::pair<std::string, ConfigNode>> overrides_;
  std::vector<RandomisedKey> randomised_;
  Sampling sampling_ = Sampling::kIndependent;  // how they are drawn
  std::vector<Variant> variants_;
  int seed_ = 0;
  std::uint64_t episode_ = 0;
  struct SiteFiles;
  std::shared_ptr<SiteFiles> site_files_;
};

// The scenario itself, whatever its matrix says: episode 0, or the one that it names.
Scenario ReadScenario(const std::filesystem::path& file,
                      const std::vector<Override>& overrides = {}, Trust trust = Trust::kNone);

}  // namespace floorproof
