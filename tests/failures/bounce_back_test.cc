// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/failures/synthetic.h"

namespace floorproof {
namespace {

std::vector<Event> Events(const Trace& trace, const std::string& yaml = "") {
  return Judge(*MakeDetector("bounce_back", yaml), trace);
}

// Thrown off at `speed_mps` for `duration_s`, `delay_s` after the impact.
Hit Rebound(double speed_mps, double duration_s = 0.1, double delay_s = 0) {
  Hit hit;
  hit.contact_s = delay_s;
  hit.after = [=](double t_s) {
    return t_s > delay_s && t_s < delay_s + duration_s ? -speed_mps : 0.0;
  };
  return hit;
}

double Evidence(const Event& event, std::string_view name) {
  for (const auto& [key, value] : event.evidence)
    if (key == name) return value;
  ADD_FAILURE() << "no evidence " << name;
  return 0;
}

TEST(BounceBack, FasterThanTheThresholdItReverses) {
  const auto rebound = [](double closing_mps, double speed_mps) {
    Hit hit = Rebound(speed_mps, 0.01);  // 10 ms keep the travel below 1 mm: the speed decides
    hit.speed_mps = closing_mps;
    return Events(DriveInto(hit));
  };
  EXPECT_TRUE(rebound(0.08, 0.024).empty());
  const auto events = rebound(0.08, 0.026);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, "reversed");
  EXPECT_EQ(events[0].hazard, "wall");
  EXPECT_NEAR(events[0].value, 0.026, 1e-9);
  EXPECT_EQ(events[0].threshold, 0.025);
  // A hard impact has to throw it back by 15 % of the closing speed.
  EXPECT_TRUE(rebound(0.4, 0.059).empty());
  EXPECT_EQ(rebound(0.4, 0.061).size(), 1u);
}

TEST(BounceBack, ChatterAgainstADeadWallIsNone) {
  // Stopped dead; then, driving on, it rocks against the wall at 0.045 m/s for as long as it
  // pushes, now touching and now not, and never parts by a millimetre.
  Hit hit;
  hit.after = [](double t_s) {
    if (t_s < 0.05) return t_s < 0.02 ? -0.001 : 0.001;
    return std::fmod(t_s, 0.032) < 0.016 ? 0.045 : -0.045;
  };
  hit.contact_s = 10;
  EXPECT_TRUE(Events(DriveInto(hit)).empty());
  const Trace flickering = With(
      DriveInto(hit),
      [](Sample& s) {
        if (std::fmod(s.t_s, 0.06) < 0.03) s.num_contacts = 0;
      },
      1.06);
  EXPECT_TRUE(Events(flickering).empty());
}

TEST(BounceBack, ReversingWhileStillPressedAgainstTheWallIsNone) {
  Hit hit = Rebound(0.06, 0.012, 0.06);
  hit.contact_s = 0.02;
  EXPECT_EQ(Events(DriveInto(hit)).size(), 1u);  // it stood there free, and left
  hit.contact_s = 5;
  EXPECT_TRUE(Events(DriveInto(hit)).empty());
}

TEST(BounceBack, SlowerItMustPartByAMillimetre) {
  EXPECT_TRUE(Events(DriveInto(Rebound(0.01, 0.1))).empty());
  const auto events = Events(DriveInto(Rebound(0.01, 0.2)));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, "parted");
  EXPECT_GT(events[0].value, events[0].threshold);
}

TEST(BounceBack, OnlyAfterAnImpact) {
  Hit touch = Rebound(0.06);
  touch.speed_mps = 0.049;
  EXPECT_TRUE(Events(DriveInto(touch)).empty());
  touch.speed_mps = 0.051;
  EXPECT_EQ(Events(DriveInto(touch)).size(), 1u);
}

// The step in which the contact appears may have stopped the body already: the contact knows how
// fast it came.
TEST(BounceBack, ClosingSpeedIsThatBeforeTheContact) {
  Trace trace = DriveInto(Rebound(0.06));
  for (Sample& s : trace) {
    if (s.num_contacts == 0) continue;
    s.v_WB_W.x() = s.V_WB_B.vx_mps = 0;
    break;
  }
  const auto events = Events(trace);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_NEAR(Evidence(events[0], "closing_mps"), 0.2, 1e-12);
}

TEST(BounceBack, OnlyWithinTheWindow) {
  Hit hit = Rebound(0.06, 0.1, 0.9);
  hit.contact_s = 0;  // it stands a hair away from the wall until then
  EXPECT_EQ(Events(DriveInto(hit)).size(), 1u);
  hit = Rebound(0.06, 0.1, 1.05);
  hit.contact_s = 0;
  EXPECT_TRUE(Events(DriveInto(hit)).empty());
}

TEST(BounceBack, PressedAgainstItForLongerThanAnElasticContactLasts) {
  EXPECT_EQ(Events(DriveInto(Rebound(0.06, 0.1, 0.04))).size(), 1u);
  EXPECT_TRUE(Events(DriveInto(Rebound(0.06, 0.04, 0.06))).empty());
}

// It is back before it has come off.
TEST(BounceBack, TheWayOutOfASoftContactIsNone) {
  const auto rebound = [](double back_m) {
    const double dt_s = 0.02;
    Hit hit;
    hit.contact_s = 2 * dt_s;
    hit.after = [=](double t_s) {
      return t_s < dt_s ? 0.05 : t_s < 2 * dt_s ? -back_m / dt_s : 0.0;
    };
    return Events(DriveInto(hit)).size();
  };
  EXPECT_EQ(rebound(0.0024), 0u);
  EXPECT_EQ(rebound(0.0028), 1u);
}

TEST(BounceBack, FarBackIsOneHoweverSlowlyItComesOff) {
  Hit hit = Rebound(0.09, 0.06, 0.02);
  hit.contact_s = 0.07;  // pressed for longer than elastic contacts last, and still touched
  const auto events = Events(DriveInto(hit));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, "parted");
  EXPECT_GT(events[0].value, events[0].threshold);
}

// It leans on the wall and turns, as it was told; another corner of it then touches no harder than
// the first did, and comes off.
TEST(BounceBack, RockingAgainstAWallIsNoneWhateverIsCommanded) {
  for (const bool pressed : {true, false}) {
    Trace trace = DriveInto(Rebound(0.03, 0.02, 0.42));
    for (Sample& s : trace) {
      s.num_contacts = 0;
      const auto touch = [&](double y_m, double closing_mps) {
        ObstacleContact& contact = s.contacts[static_cast<std::size_t>(s.num_contacts++)];
        contact = {};
        contact.p_W = {s.p_WB.x() + 0.2, y_m};
        contact.normal_W = {-1, 0};
        contact.closing_mps = closing_mps;
      };
      const double t_s = s.t_s - 1.0;
      if (t_s > 0 && t_s < 0.41 && pressed) touch(0.15, 0.2);
      if (t_s > 0.4 && t_s < 0.42) touch(-0.15, 0.19);
      if (t_s > 0.05 && t_s < 0.35) s.command.twist = {-0.06, 0, 0};
    }
    EXPECT_EQ(Events(trace).empty(), pressed);
  }
}

// One corner meets the wall, then a second one, more softly, which comes off as the robot swings
// about the first. Alone it would be a rebound.
TEST(BounceBack, ASecondCornerThatSwingsOffIsNone) {
  for (const bool both : {true, false}) {
    Trace trace = DriveInto(Rebound(0.03, 0.02, 0.05));
    for (Sample& s : trace) {
      s.num_contacts = 0;
      const auto touch = [&](double y_m, double closing_mps) {
        ObstacleContact& contact = s.contacts[static_cast<std::size_t>(s.num_contacts++)];
        contact = {};
        contact.p_W = {s.p_WB.x() + 0.2, y_m};
        contact.normal_W = {-1, 0};
        contact.closing_mps = closing_mps;
      };
      const double t_s = s.t_s - 1.0;
      if (t_s > 0 && t_s < 0.03 && both) touch(0.15, 0.4);
      if (t_s > 0.03 && t_s < 0.05) touch(-0.15, 0.08);
    }
    EXPECT_EQ(Events(trace).empty(), both);
  }
}

TEST(BounceBack, BackingOffOnPurposeIsNone) {
  Hit hit = Rebound(0.06);
  hit.command_after_mps = -0.06;
  EXPECT_TRUE(Events(DriveInto(hit)).empty());
  hit.command_after_mps = 0;  // it stopped commanding, and is thrown back all the same
  EXPECT_EQ(Events(DriveInto(hit)).size(), 1u);
}

TEST(BounceBack, TurningARoundBodyBesideTheWallIsNone) {
  Trace trace = DriveInto(Rebound(0.0));
  trace = With(
      trace,
      [](Sample& s) {
        s.yaw_rad = s.t_s - 1.0;
        s.V_WB_B.wz_radps = 1;
        s.command.twist = {0, 0, 1};
      },
      1.004);
  EXPECT_TRUE(Events(trace).empty());
}

TEST(BounceBack, PushingOnStaysSilent) {
  Hit hit = Rebound(0.0);
  hit.contact_s = 5;
  const auto dut = MakeDetector("bounce_back");
  EXPECT_TRUE(Judge(*dut, DriveInto(hit)).empty());
  EXPECT_EQ(dut->margin(), 0.025);
}

TEST(BounceBack, EvidenceHasTheWholeRebound) {
  Hit hit;  // pressed in by 1 mm, thrown back fast, then slower and slower: 10 mm in all
  hit.contact_s = 0.03;
  hit.after = [](double t_s) {
    if (t_s < 0.01) return 0.05;
    if (t_s < 0.06) return -0.1;
    return t_s < 0.16 ? -0.05 : 0.1;
  };
  const auto events = Events(DriveInto(hit));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_NEAR(Evidence(events[0], "closing_mps"), 0.2, 1e-9);
  EXPECT_NEAR(Evidence(events[0], "rebound_mps"), 0.1, 1e-9);
  EXPECT_NEAR(Evidence(events[0], "travel_back_m"), 0.010, 0.0008);
  EXPECT_NEAR(events[0].t_s, 1.032, 1.5 * kStepS) << "when it came off, not when it came to rest";
}

TEST(BounceBack, TheEndOfTheEpisodeLosesNoRebound) {
  Trace trace = With(
      DriveInto(Rebound(0.06, 5)), [](Sample& s) { s.command.done = true; }, 1.05);
  const auto events = Events(trace);
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].kind, "reversed");
}

// Its nose pitches up at the wall: what touched, at 0.16 m, leaves the wall at 0.08 m/s, and its
// centre of mass, half as high, does not; or the other way round. Together they are a rebound.
TEST(BounceBack, APitchIsNone) {
  const auto events = [](double way_mps, double pitch_radps) {
    Hit hit = Rebound(way_mps, 7.5 * kStepS);
    const Trace trace = With(
        DriveInto(hit),
        [=](Sample& s) {
          s.contacts[0].height_m = 0.16;
          s.pitch_rad = pitch_radps * std::clamp(s.t_s - 1.0, 0.0, 7 * kStepS);
        },
        0.9);
    return Events(trace).size();
  };
  EXPECT_EQ(events(-0.08, -1), 0u) << "the centre of mass stays where it is";
  EXPECT_EQ(events(0.08, 1), 0u) << "the nose dips as the body rolls back";
  EXPECT_EQ(events(0.08, 0), 1u);
}

// But for what it climbs by its own grip.
TEST(BounceBack, AWheelThatHitsCountsAsTheBodyDoes) {
  const auto events = [](double speed_mps) {
    return Events(With(DriveInto(Rebound(speed_mps, 0.02)), [](Sample& s) {
      s.contacts[0].wheel = true;
      s.contacts[0].hazard = kStepHazard;
    }));
  };
  EXPECT_TRUE(events(0.099).empty());
  ASSERT_EQ(events(0.101).size(), 1u);
  EXPECT_EQ(events(0.101)[0].hazard, "sill");
}

// A wheel that does not get up a kerb and rolls back down: slowly, and its edge touches all the
// way.
TEST(BounceBack, RollingBackFromAKerbIsNone) {
  Hit hit = Rebound(0.05, 0.4, 0.2);
  hit.contact_s = 0.5;
  const Trace trace = With(DriveInto(hit), [](Sample& s) { s.contacts[0].wheel = true; });
  EXPECT_TRUE(Events(trace).empty());
}

TEST(BounceBack, NamesTheHazardHit) {
  const auto events = Events(
      With(DriveInto(Rebound(0.06)), [](Sample& s) { s.contacts[0].hazard = kGlassHazard; }));
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].hazard, "door");
}

TEST(BounceBack, MarginIsTheReboundStillLeft) {
  const auto dut = MakeDetector("bounce_back");
  Judge(*dut, DriveInto(Rebound(0.015, 0.02)));
  EXPECT_NEAR(dut->margin(), (1 - 0.015 / 0.03) * 0.025, 1e-9) << "15 % of 0.2 m/s";
  Judge(*dut, DriveInto(Rebound(0.06, 0.1)));
  EXPECT_LT(dut->margin(), 0);
}

}  // namespace
}  // namespace floorproof
