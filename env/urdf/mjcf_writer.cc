// SPDX-License-Identifier: Apache-2.0
#include "env/urdf/mjcf_writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "base/markup.h"
#include "base/printable.h"

namespace floorproof {
namespace {

// To a ten-millionth: what a URDF's turned frames leave in the last digits is not written.
std::string N(double value) {
  constexpr double kDigits = 1e7;
  return FormatDouble(std::round(value * kDigits) / kDigits + 0.0);
}
std::string N(const Vec3& v) { return N(v.x()) + " " + N(v.y()) + " " + N(v.z()); }

// A comment may not hold two dashes.
std::string Undashed(std::string text) {
  for (std::size_t at; (at = text.find("--")) != std::string::npos;) text.replace(at, 2, "- ");
  return Printable(text);
}
std::string Comment(std::string text) { return "<!-- " + Undashed(std::move(text)) + " -->"; }

class Writer {
 public:
  Writer(const UrdfRobot& robot, const RobotGuesses& guesses, const UrdfAnswers& answers)
      : robot_(robot), guesses_(guesses), answers_(answers) {}

  std::string Write(const std::string& source) {
    Head(source);
    Custom();
    Defaults();
    World();
    Motors();
    out_ += "</mujoco>\n";
    // Hulls are known when all bodies are written; an asset may stand anywhere.
    const std::string assets = assets_.empty() ? "" : "  <asset>\n" + assets_ + "  </asset>\n";
    out_.insert(out_.find("  <worldbody>"), assets);
    return std::move(out_);
  }

 private:
  void Line(int depth, const std::string& text) {
    out_ += std::string(static_cast<std::size_t>(2 * depth), ' ') + text + "\n";
  }

  void Head(const std::string& source) {
    out_ += "<!--\n  " + Undashed(robot_.name.empty() ? "A robot" : robot_.name) +
            ", made of the URDF " + Undashed(source) + ".\n" +
            "  What follows \"guess:\" the URDF does not say: put in what you know, and drop the "
            "word.\n" +
            "  Frame B (body base): on the floor below the middle of the driven wheels, x forward, "
            "y left, z up.\n";
    for (const std::string& note : robot_.notes) out_ += "  * " + Undashed(note) + "\n";
    out_ += "-->\n<mujoco>\n";
  }

  void Number(const char* name, const Figure& figure) {
    Line(2, fmt::format("<numeric name=\"{}\" data=\"{}\"/>  {}", name, N(figure.value),
                        Comment(figure.why)));
  }

  void Text(const char* name, const Choice& choice) {
    Line(2, fmt::format("<text name=\"{}\" data=\"{}\"/>  {}", name, choice.value,
                        Comment(choice.why)));
  }

  void Custom() {
    Line(1, "<custom>");
    Line(2, "<text name=\"drive\" data=\"" + robot_.drive + "\"/>");
    const char* shape = robot_.holonomic ? "footprint" : "circle";
    for (const char* name : {"clear_shape", "tool_shape"})
      Line(2, fmt::format("<text name=\"{}\" data=\"{}\"/>  {}", name, shape,
                          Comment("guess: what it keeps clear, and what it sweeps")));
    Text("standstill", guesses_.standstill);
    Text("tyre", guesses_.tyre);
    Text("caster", guesses_.caster);
    Number("tool_width_m", guesses_.tool_width_m);
    Number("step_m", guesses_.step_m);
    Number("cruise_mps", guesses_.cruise_mps);
    Number("max_speed_mps", guesses_.max_speed_mps);
    Number("max_accel_mps2", guesses_.max_accel_mps2);
    Number("max_yaw_rate_radps", guesses_.max_yaw_rate_radps);
    Number("max_yaw_accel_radps2", guesses_.max_yaw_accel_radps2);
    Number("hotel_load_w", guesses_.hotel_load_w);
    Line(1, "</custom>");
    Line(1, "<compiler angle=\"radian\" autolimits=\"true\"/>");
    if (robot_.wheels.front().roller_radius_m > 0) Line(1, "<size nuser_geom=\"2\"/>");
  }

  void Defaults() {
    Line(1, "<default>");
    Line(2,
         "<default class=\"body\"><geom contype=\"0\" conaffinity=\"3\" friction=\"0.3 0.005 "
         "0.0001\"/></default>");
    Line(2,
         "<default class=\"look\"><geom contype=\"0\" conaffinity=\"0\" mass=\"0\" "
         "group=\"1\"/></default>");
    Line(2, "<default class=\"wheel\">");
    Line(3,
         "<geom type=\"cylinder\" contype=\"0\" conaffinity=\"1\" condim=\"3\" rgba=\"0.15 0.15 "
         "0.16 1\"/>");
    Line(3, Comment("armature: " + guesses_.armature_kgm2.why));
    Line(3, Comment("frictionloss: " + guesses_.friction_nm.why));
    Line(3, fmt::format("<joint type=\"hinge\" armature=\"{}\" frictionloss=\"{}\"/>",
                        N(guesses_.armature_kgm2.value), N(guesses_.friction_nm.value)));
    Line(3, Comment("stall torque: " + guesses_.stall_nm.why));
    Line(3, Comment("speed without load: " + guesses_.no_load_radps.why));
    Line(3, Comment("the driver's gain: " + guesses_.driver_gain.why));
    const std::string volt = N(answers_.motor_voltage_v);
    if (guesses_.peak_nm)
      Line(3, Comment("saturation: given, what the driver's current limit gives"));
    const std::string limit =
        guesses_.peak_nm ? " saturation=\"" + N(*guesses_.peak_nm) + " 0 0\"" : "";
    Line(3,
         fmt::format("<dcmotor nominal=\"{} {} {}\"{} input=\"vel\" controller=\"0 0 {} 0 0 {}\"/>",
                     volt, N(guesses_.stall_nm.value), N(guesses_.no_load_radps.value), limit,
                     N(guesses_.driver_gain.value), volt));
    Line(2, "</default>");
    Line(2, Comment("guess: a caster's bearings give next to no friction"));
    Line(2,
         "<default class=\"caster\"><geom type=\"cylinder\" contype=\"0\" conaffinity=\"1\" "
         "condim=\"3\"/><joint type=\"hinge\" armature=\"0.0001\" damping=\"0.0005\"/></default>");
    Line(2, Comment("guess: a ball slides with friction 0.02"));
    Line(2,
         "<default class=\"ball\"><geom type=\"sphere\" contype=\"0\" conaffinity=\"1\" "
         "condim=\"3\" priority=\"2\" friction=\"0.02 0 0\" mass=\"0\"/></default>");
    Line(1, "</default>");
  }

  void Inertial(int depth, const MassOf& mass, const Vec3& origin) {
    const Mat3& I = mass.inertia_M;
    constexpr double kFine = 1e10;  // small wheels' moments need more digits than places
    const auto fine = [](double value) {
      return FormatDouble(std::round(value * kFine) / kFine + 0.0);
    };
    Line(depth, fmt::format("<inertial pos=\"{}\" mass=\"{}\" fullinertia=\"{} {} {} {} {} {}\"/>",
                            N(mass.com_M - origin), N(mass.mass_kg), fine(I(0, 0)), fine(I(1, 1)),
                            fine(I(2, 2)), fine(I(0, 1)), fine(I(0, 2)), fine(I(1, 2))));
  }

  void Shape(int depth, const UrdfShape& shape, const Vec3& origin, bool collides) {
    using Kind = UrdfShape::Kind;
    std::string form;
    switch (shape.kind) {
      case Kind::kBox:
        form = "type=\"box\" size=\"" + N(shape.size) + "\"";
        break;
      case Kind::kCylinder:
      case Kind::kCapsule:
        form = fmt::format("type=\"{}\" size=\"{} {}\"",
                           shape.kind == Kind::kCylinder ? "cylinder" : "capsule",
                           N(shape.size.x()), N(shape.size.y()));
        break;
      case Kind::kSphere:
        form = "type=\"sphere\" size=\"" + N(shape.size.x()) + "\"";
        break;
      case Kind::kHull:
        form = "type=\"mesh\" mesh=\"" + Hull(shape) + "\"";
        break;
    }
    const Eigen::Quaterniond q(shape.R_M);
    const auto& c = shape.rgba;
    Line(depth,
         fmt::format("<geom class=\"{}\" {} pos=\"{}\" quat=\"{} {} {} {}\" rgba=\"{:.3g} {:.3g} "
                     "{:.3g} {:.3g}\"/>",
                     collides ? "body" : "look", form, N(shape.p_M - origin), N(q.w()), N(q.x()),
                     N(q.y()), N(q.z()), c[0], c[1], c[2], c[3]));
  }

  std::string Hull(const UrdfShape& shape) {
    const std::string name = "hull_" + std::to_string(hulls_++);
    assets_ += "    <mesh name=\"" + name + "\" vertex=\"";
    for (std::size_t i = 0; i < shape.hull.size(); ++i)
      assets_ += (i > 0 ? "  " : "") + N(shape.hull[i]);
    assets_ += "\"/>\n";
    return name;
  }

  // Looks of a part that collides as something else; dark as tyres where the file gives none.
  void Looks(int depth, const std::vector<UrdfShape>& shapes, const Vec3& origin) {
    const bool seen = std::any_of(shapes.begin(), shapes.end(),
                                  [](const UrdfShape& shape) { return !shape.collides; });
    for (UrdfShape shape : shapes) {
      if (shape.collides == seen) continue;
      if (!seen) shape.rgba = {0.2F, 0.2F, 0.21F, 1};
      Shape(depth, shape, origin, false);
    }
  }

  // No two bodies have one name, and none is called `base`.
  std::string Unique(const std::string& name) {
    std::string given = name;
    for (int k = 2; !bodies_.insert(given).second; ++k) given = name + " " + std::to_string(k);
    return MarkupText(given);
  }

  static std::string Rollers(const UrdfWheel& wheel) {
    return fmt::format(" user=\"{} {}\"", N(wheel.roller_radius_m), N(wheel.roller_angle_rad));
  }

  // Its stops are as far down as up from where the wheel stands.
  void Spring(int depth, const WheelSpring& spring) {
    Line(depth,
         fmt::format("<joint type=\"slide\" axis=\"0 0 1\" range=\"{0} {1}\" stiffness=\"{2}\" "
                     "springref=\"{3}\" damping=\"{4}\"/>  {5}",
                     N(-spring.travel_m), N(spring.travel_m), N(spring.stiffness_npm),
                     N(spring.slack_m), N(spring.damping_nspm),
                     Comment("its travel: " + guesses_.spring_travel_m.why +
                             "; its preload: " + guesses_.spring_preload.why)));
  }

  void Wheel(int depth, const UrdfWheel& wheel, const Vec3& carrier, const char* kind,
             const WheelSpring* spring = nullptr) {
    const std::string name = Unique(wheel.name);
    Line(depth, fmt::format("<body name=\"{}\" pos=\"{}\">", name, N(wheel.p_B - carrier)));
    if (spring != nullptr) Spring(depth + 1, *spring);
    Line(depth + 1,
         fmt::format("<joint name=\"{}\" class=\"{}\" axis=\"{}\"/>", name, kind, N(wheel.axle_B)));
    Inertial(depth + 1, wheel.mass, wheel.p_B);
    const bool rollers = wheel.roller_radius_m > 0;
    Line(depth + 1,
         fmt::format("<geom class=\"{}\" size=\"{} {}\" zaxis=\"{}\"{}/>  {}", kind,
                     N(wheel.radius_m - wheel.roller_radius_m), N(wheel.half_width_m),
                     N(wheel.axle_B), rollers ? Rollers(wheel) : "",
                     Comment(rollers ? "the core within the rollers; guess: half the wheel's width"
                                     : "guess: a tyre touches the floor with half its width")));
    Looks(depth + 1, wheel.looks, wheel.p_B);
    Line(depth, "</body>");
    if (kind == std::string_view("wheel")) motors_.push_back(name);
  }

  void Caster(const UrdfCaster& caster) {
    switch (caster.kind) {
      case UrdfCaster::Kind::kWheel:
        Wheel(3, caster.wheel, Vec3::Zero(), "caster");
        break;
      case UrdfCaster::Kind::kBall:
        Line(3,
             fmt::format("<body name=\"{}\" pos=\"{}\"><geom class=\"ball\" size=\"{}\"/></body>",
                         Unique(caster.name), N(caster.wheel.p_B), N(caster.wheel.radius_m)));
        break;
      case UrdfCaster::Kind::kSwivel: {
        const std::string name = Unique(caster.name);
        Line(3, fmt::format("<body name=\"{}\" pos=\"{}\">", name, N(caster.pivot_B)));
        Line(4, fmt::format("<joint name=\"{}\" class=\"caster\" axis=\"0 0 1\"/>", name));
        if (caster.fork.mass_kg > 0) Inertial(4, caster.fork, caster.pivot_B);
        Looks(4, caster.fork_looks, caster.pivot_B);
        Wheel(4, caster.wheel, caster.pivot_B, "caster");
        Line(3, "</body>");
        break;
      }
    }
  }

  void World() {
    Line(1, "<worldbody>");
    Line(2, "<body name=\"base\">");
    bodies_.insert("base");
    Line(3, "<freejoint/>");
    Inertial(3, robot_.base, Vec3::Zero());
    for (const UrdfShape& shape : robot_.shapes) Shape(3, shape, Vec3::Zero(), shape.collides);
    for (const auto& [name, place] : {std::pair("lidar", robot_.lidar_B), {"imu", robot_.imu_B}})
      if (place) Line(3, fmt::format("<site name=\"{}\" pos=\"{}\"/>", name, N(*place)));
    for (std::size_t i = 0; i < robot_.wheels.size(); ++i)
      Wheel(3, robot_.wheels[i], Vec3::Zero(), "wheel",
            guesses_.springs.empty() ? nullptr : &guesses_.springs[i]);
    for (const UrdfCaster& caster : robot_.casters) Caster(caster);
    Line(2, "</body>");
    Line(1, "</worldbody>");
  }

  void Motors() {
    Line(1, "<actuator>");
    for (const std::string& name : motors_)
      Line(2, fmt::format("<dcmotor name=\"{0}\" joint=\"{0}\" class=\"wheel\"/>", name));
    Line(1, "</actuator>");
  }

  const UrdfRobot& robot_;
  const RobotGuesses& guesses_;
  const UrdfAnswers& answers_;
  std::string out_, assets_;
  std::set<std::string> bodies_;
  std::vector<std::string> motors_;
  int hulls_ = 0;
};

}  // namespace

std::string WriteMjcf(const UrdfRobot& robot, const RobotGuesses& guesses,
                      const UrdfAnswers& answers, const std::string& source) {
  return Writer(robot, guesses, answers).Write(source);
}

}  // namespace floorproof
