// SPDX-License-Identifier: Apache-2.0
// The wheel collider: one wheel pressed on a floor.
#include "env/scene/wheel_collider.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

#include "env/geometry/geometry.h"
#include "env/scene/engine.h"

namespace floorproof {
namespace {

constexpr double kCore_m = 0.023, kRoller_m = 0.007;

// A wheel 30 mm over z = 0 less `sunk_m`, rolled sideways by lean_rad about x, above a floor of
// this kind; the pair is the model's only contact.
struct OneWheel {
  SpecPtr spec{mj_makeSpec()};
  ModelPtr model;
  DataPtr data;

  OneWheel(double sunk_m, double lean_rad, mjtGeom floor_type, double angle_rad,
           double roller_m = kRoller_m) {
    InstallWheelCollider();
    spec->nuser_geom = 2;
    mjsBody* world = mjs_findBody(spec.get(), "world");
    mjsGeom* floor = mjs_addGeom(world, nullptr);
    mjs_setName(floor->element, "floor");
    floor->type = floor_type;
    floor->size[0] = floor->size[1] = 1;
    floor->size[2] = 0.1;
    if (floor_type == mjGEOM_BOX) floor->pos[2] = -0.1;
    mjsBody* body = mjs_addBody(world, nullptr);
    body->pos[2] = kCore_m + kRoller_m - sunk_m;
    body->quat[0] = std::cos(lean_rad / 2);
    body->quat[1] = std::sin(lean_rad / 2);
    mjs_addFreeJoint(body);
    mjsGeom* wheel = mjs_addGeom(body, nullptr);
    mjs_setName(wheel->element, "wheel");
    wheel->type = mjGEOM_CYLINDER;
    wheel->size[0] = kCore_m;
    wheel->size[1] = 0.0055;
    wheel->quat[0] = std::cos(-kPi / 4);  // the cylinder's z along the body's y
    wheel->quat[1] = std::sin(-kPi / 4);
    wheel->contype = wheel->conaffinity = 0;
    const double user[2] = {roller_m, angle_rad};
    mjs_setDouble(wheel->userdata, user, 2);
    MarkPaired(spec.get(), wheel);
    mjsPair* pair = mjs_addPair(spec.get(), nullptr);
    mjs_setString(pair->geomname1, "wheel");
    mjs_setString(pair->geomname2, "floor");
    pair->condim = 3;
    const double friction[5] = {0.8, 0, 0, 0, 0};
    std::copy(std::begin(friction), std::end(friction), pair->friction);
    model = CompileSpec(spec.get());
    InflateWheelBounds(model.get());
    data = MakeData(model.get());
    ForwardEngine(model.get(), data.get());
  }
};

// Another program's model in this process, whose cylinders have user data of their own.
TEST(WheelCollider, WhatWasNotPairedIsLeftAlone) {
  for (const int numbers : {1, 2, 3, 5}) {
    OneWheel stranger(0.001, 0, mjGEOM_PLANE, kPi / 4);
    ASSERT_EQ(stranger.data->ncon, 1);
    mjsPair* pair = mjs_asPair(mjs_firstElement(stranger.spec.get(), mjOBJ_PAIR));
    ASSERT_NE(pair, nullptr);
    stranger.spec->nuser_geom = numbers;
    mjsGeom* wheel = mjs_asGeom(mjs_findElement(stranger.spec.get(), mjOBJ_GEOM, "wheel"));
    const double user[5] = {kRoller_m, kPi / 4, 0, 0, 0};
    mjs_setDouble(wheel->userdata, user, numbers);
    stranger.model = CompileSpec(stranger.spec.get());
    stranger.data = MakeData(stranger.model.get());
    ForwardEngine(stranger.model.get(), stranger.data.get());
    EXPECT_EQ(stranger.data->ncon, 0) << "its core ends 6 mm above the floor";
  }
}

TEST(WheelCollider, AWheelThatStandsUprightTouchesOnceBelowItsMiddle) {
  for (const mjtGeom floor : {mjGEOM_PLANE, mjGEOM_BOX}) {
    OneWheel dut(0.001, 0, floor, kPi / 4);
    ASSERT_EQ(dut.data->ncon, 1);
    const mjContact& c = dut.data->contact[0];
    EXPECT_NEAR(c.dist, -0.001, 1e-6);
    EXPECT_NEAR(c.pos[0], 0, 1e-5);
    EXPECT_NEAR(c.pos[1], 0, 1e-5);
    EXPECT_NEAR(c.pos[2], -0.0005, 1e-6);
  }
}

// The roller's axis, seen from above: the axle (y) turned by the angle, counterclockwise.
TEST(WheelCollider, FrictionActsAlongTheRollersAxis) {
  for (const double angle : {kPi / 4, -kPi / 4, 0.6}) {
    OneWheel dut(0.001, 0, mjGEOM_PLANE, angle);
    ASSERT_EQ(dut.data->ncon, 1);
    const mjContact& c = dut.data->contact[0];
    const Vec2 tangent(c.frame[3], c.frame[4]);
    EXPECT_NEAR(std::abs(tangent.dot(Vec2(-std::sin(angle), std::cos(angle)))), 1, 1e-9);
    EXPECT_NEAR(c.friction[0], 0.8, 1e-12);
    EXPECT_LE(c.friction[1], 1e-5);
  }
}

// Leaning by a, the rim's round edge is lowest: the core's corner goes down by w sin a, and rises
// by what its radius loses; the rollers add r below it whatever the lean.
TEST(WheelCollider, ALeaningWheelIsRoundedByItsRollers) {
  for (const double lean : {0.05, 0.2, -0.4}) {
    OneWheel dut(0.004, lean, mjGEOM_PLANE, kPi / 4);
    ASSERT_GE(dut.data->ncon, 1);
    const double centre = kCore_m + kRoller_m - 0.004;
    const double low =
        centre - kCore_m * std::cos(lean) - 0.0055 * std::abs(std::sin(lean)) - kRoller_m;
    EXPECT_NEAR(dut.data->contact[0].dist, low, 2e-6) << lean;
  }
}

TEST(WheelCollider, AboveTheFloorItTouchesNothing) {
  OneWheel dut(-0.001, 0, mjGEOM_PLANE, kPi / 4);
  EXPECT_EQ(dut.data->ncon, 0);
}

// Its stiffness counts once, below its middle, as long as it stands upright.
TEST(WheelCollider, APlainWheelTouchesOnceToo) {
  for (const mjtGeom floor : {mjGEOM_PLANE, mjGEOM_BOX}) {
    OneWheel upright(0.001 + kRoller_m, 0, floor, 0, 0);
    ASSERT_EQ(upright.data->ncon, 1);
    EXPECT_NEAR(upright.data->contact[0].dist, -0.001, 1e-6);
    EXPECT_NEAR(upright.data->contact[0].pos[1], 0, 1e-5);
    OneWheel leaning(0.001 + kRoller_m, 0.1, floor, 0, 0);
    ASSERT_EQ(leaning.data->ncon, 1);
    EXPECT_NEAR(leaning.data->contact[0].dist,
                kCore_m - 0.001 - kCore_m * std::cos(0.1) - 0.0055 * std::sin(0.1), 2e-6);
  }
}

}  // namespace
}  // namespace floorproof
