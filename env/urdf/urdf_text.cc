// SPDX-License-Identifier: Apache-2.0
#include "env/urdf/urdf_text.h"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <utility>

#include "base/error.h"
#include "base/params.h"
#include "base/printable.h"
#include "env/scene/engine_files.h"
#include "env/scene/xml_numbers.h"
#include "env/scene/xml_tags.h"
#include "env/urdf/collada.h"
#include "env/urdf/mesh_path.h"

namespace floorproof {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t kMaxBytes = 4u << 20;
constexpr int kMaxLinks = 500;  // of a floor robot; MuJoCo's importer takes seconds for thousands
constexpr std::size_t kStart = 1u << 16;

double NumberOf(std::string_view text) { return std::strtod(std::string(text).c_str(), nullptr); }

class Preparation {
 public:
  Preparation(const fs::path& file, const InputFiles& files)
      : file_(file),
        files_(files),
        text_(files.Read(file, kMaxBytes)),
        elements_(XmlElements(text_)) {}

  UrdfText Make() {
    if (elements_.empty() || elements_[0].name != "robot")
      Refuse(1, "", "", "is no URDF: its root element is not <robot>");
    RefuseBadNumbers(elements_, text_, file_.string());
    out_.robot = DecodeXml(elements_[0].Value("name"));
    RefuseXacro();
    RefuseHalf();
    ReadLinks();
    ReadJoints();
    RefuseNoTree();
    Meshes();
    for (std::size_t i = 0; i < elements_.size(); ++i)
      if (elements_[i].name == "mujoco" && elements_[i].parent == 0) {
        Blank(elements_[i]);
        out_.notes.push_back("its section <mujoco> is not read: the physics is the program's");
      }
    Write();
    return std::move(out_);
  }

 private:
  [[noreturn]] void Refuse(int line, const std::string& key, const std::string& value,
                           const std::string& rule) const {
    throw InputError({file_.string(), line}, key, value, rule);
  }

  void RefuseXacro() const {
    const std::string rule =
        "is xacro, not yet URDF: expand it first, `xacro FILE > my_robot.urdf`";
    for (const XmlElement& e : elements_) {
      if (e.name.starts_with("xacro:")) Refuse(e.line, "", std::string(e.name), rule);
      for (const XmlAttribute& a : e.attributes)
        if (a.value.find("${") != a.value.npos || a.value.find("$(") != a.value.npos)
          Refuse(e.line, std::string(e.name), std::string(a.value), rule);
    }
  }

  // Of a file that was cut short, whatever is missing would be named instead.
  void RefuseHalf() const {
    if (elements_[0].closed) return;
    Refuse(LineAt(text_, text_.size()), "robot", out_.robot,
           "is XML that does not end: the text stops before </robot>");
  }

  std::string NameOf(const XmlElement& e) const {
    std::string name = DecodeXml(e.Value("name"));
    if (name.empty()) Refuse(e.line, std::string(e.name), "", "needs a name");
    if (const std::string why = WhyUnprintable(name); !why.empty())
      Refuse(e.line, std::string(e.name), name, why);
    return name;
  }

  void ReadLinks() {
    for (const XmlElement& e : elements_) {
      if (e.name != "link" || e.parent != 0) continue;
      if (!links_.emplace(NameOf(e), e.line).second)
        Refuse(e.line, "link", NameOf(e), "two links have this name");
    }
    if (links_.empty()) Refuse(elements_[0].line, "robot", out_.robot, "has no link");
    if (links_.size() > kMaxLinks)
      Refuse(elements_[0].line, "link", std::to_string(links_.size()),
             "must be at most " + std::to_string(kMaxLinks));
  }

  // The first element of this name within the other.
  const XmlElement* Within(std::size_t parent, std::string_view name) const {
    for (std::size_t i = parent + 1; i < elements_.size(); ++i) {
      if (elements_[i].begin >= elements_[parent].end) break;
      if (elements_[i].parent == static_cast<int>(parent) && elements_[i].name == name)
        return &elements_[i];
    }
    return nullptr;
  }

  std::string LinkOf(std::size_t joint, std::string_view end) const {
    const XmlElement* e = Within(joint, end);
    const std::string link = e != nullptr ? DecodeXml(e->Value("link")) : "";
    if (!links_.contains(link))
      Refuse(e != nullptr ? e->line : elements_[joint].line, std::string(end), link,
             "names no link of this robot");
    return link;
  }

  void ReadJoints() {
    for (std::size_t i = 0; i < elements_.size(); ++i) {
      const XmlElement& e = elements_[i];
      if (e.name != "joint" || e.parent != 0) continue;
      UrdfJoint joint{
          NameOf(e), std::string(e.Value("type")), LinkOf(i, "parent"), LinkOf(i, "child"), 0, 0,
          e.line};
      static constexpr std::string_view kTypes[] = {"revolute", "continuous", "prismatic", "fixed",
                                                    "spherical"};
      if (std::ranges::find(kTypes, joint.type) == std::end(kTypes))
        Refuse(e.line, "joint " + joint.name, joint.type,
               "must be revolute, continuous, prismatic or fixed; what joins the robot to the "
               "world, fixed: the program puts it on the floor");
      if (const XmlElement* limit = Within(i, "limit"); limit != nullptr) {
        joint.effort = NumberOf(limit->Value("effort"));
        joint.velocity = NumberOf(limit->Value("velocity"));
      }
      out_.joints.push_back(std::move(joint));
    }
  }

  void RefuseNoTree() const {
    std::map<std::string, const UrdfJoint*> above;
    for (const UrdfJoint& joint : out_.joints) {
      const auto [other, fresh] = above.try_emplace(joint.child, &joint);
      if (!fresh)
        Refuse(joint.line, "joint", joint.name,
               "closes a loop: link " + joint.child + " hangs on joint " + other->second->name +
                   " already; leave one out");
    }
    std::string root;
    for (const auto& [link, line] : links_) {
      if (above.contains(link)) continue;
      if (!root.empty())
        Refuse(line, "link", link,
               "hangs on nothing, and so does " + root + ": join the two by a fixed joint");
      root = link;
    }
    for (const auto& [link, line] : links_) {
      std::string at = link;
      for (std::size_t steps = 0; above.contains(at); ++steps) {
        at = above.at(at)->parent;
        if (steps > links_.size())
          Refuse(line, "link", link, "hangs on itself: its joints run in a circle");
      }
    }
    if (links_.contains("world") && root != "world")
      Refuse(links_.at("world"), "link", "world", "must be the root, or have another name");
  }

  void Meshes() {
    for (std::size_t i = 0; i < elements_.size(); ++i) {
      if (elements_[i].name != "mesh") continue;
      const int geometry = elements_[i].parent;
      const int holder = geometry >= 0 ? elements_[static_cast<std::size_t>(geometry)].parent : -1;
      if (holder < 0) continue;
      for (const XmlAttribute& a : elements_[i].attributes)
        if (a.name == "filename")
          Mesh(elements_[i], a, elements_[static_cast<std::size_t>(holder)]);
    }
  }

  void Mesh(const XmlElement& mesh, const XmlAttribute& written, const XmlElement& holder) {
    const std::string uri = DecodeXml(written.value);
    const SourceMark mark{file_.string(), mesh.line};
    MeshPlace place = FindMesh(uri, file_, mark, files_);
    const auto known = std::ranges::find(out_.meshes, place.file, &UrdfMesh::file);
    const bool is_known = known != out_.meshes.end();
    std::string obj;
    if (place.is_collada && !is_known) {
      const bool is_seen = holder.name == "visual";
      try {
        obj = ObjOfCollada(files_.Read(place.file, EngineFiles::kMaxBytes));
      } catch (const InputError& e) {
        if (!is_seen) throw InputError(mark, "mesh", uri, e.what());
        place = {{}, "", false, std::string("is ") + e.what()};
      }
    }
    if (place.file.empty()) {
      const std::string why = "mesh " + Printable(uri) + " " + place.why;
      out_.notes.push_back(why + ": left out of the " + std::string(holder.name));
      if (holder.name == "collision" && holder.parent >= 0)
        out_.lost_collisions.push_back(
            {DecodeXml(elements_[static_cast<std::size_t>(holder.parent)].Value("name")), why});
      Blank(holder);
      return;
    }
    // By names of our own: the importer takes two files of one name for one.
    std::string name =
        is_known ? known->name : "mesh" + std::to_string(out_.meshes.size()) + place.extension;
    if (!is_known) out_.meshes.push_back({name, place.file, std::move(obj)});
    edits_.push_back({written.begin, written.begin + written.value.size(), std::move(name)});
  }

  void Blank(const XmlElement& e) {
    const auto lines = std::count(text_.begin() + static_cast<std::ptrdiff_t>(e.begin),
                                  text_.begin() + static_cast<std::ptrdiff_t>(e.end), '\n');
    edits_.push_back({e.begin, e.end, std::string(static_cast<std::size_t>(lines), '\n')});
  }

  void Write() {
    edits_.push_back({elements_[1].begin, elements_[1].begin,
                      "<mujoco><compiler discardvisual=\"false\" fusestatic=\"false\"/></mujoco>"});
    std::ranges::stable_sort(edits_, {}, [](const Edit& e) { return std::pair(e.begin, e.end); });
    std::size_t at = 0;
    for (const Edit& edit : edits_) {
      if (edit.begin < at) continue;  // within what was blanked
      out_.xml.append(text_, at, edit.begin - at);
      out_.xml += edit.text;
      at = edit.end;
    }
    out_.xml.append(text_, at);
  }

  struct Edit {
    std::size_t begin, end;
    std::string text;
  };

  fs::path file_;
  const InputFiles& files_;
  const std::string& text_;
  std::vector<XmlElement> elements_;
  std::map<std::string, int> links_;  // line by name
  std::vector<Edit> edits_;
  UrdfText out_;
};

}  // namespace

bool IsUrdf(const fs::path& file, const InputFiles& files) {
  if (!files.WhyUnreadable(file, kMaxBytes).empty()) return false;
  const std::string start = files.ReadStart(file, kStart, kMaxBytes);
  const auto elements = XmlElements(start);
  return !elements.empty() && elements[0].name == "robot";
}

UrdfText PrepareUrdf(const fs::path& file, const InputFiles& files) {
  return Preparation(file, files).Make();
}

}  // namespace floorproof
