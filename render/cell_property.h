// SPDX-License-Identifier: Apache-2.0
// What Li et al. tell apart of a floor's cells (Figs. 5, 6 and 8), in colours that every eye tells
// apart. Occupied cells look as on all maps.
#pragma once

#include <array>
#include <string_view>

#include "render/text.h"

namespace floorproof {

enum class CellProperty { kNotCovered, kOnce, kTwice, kMore, kOutOfReach };
inline constexpr int kNumCellProperties = 5;

constexpr CellProperty PropertyOf(int visits) {
  return visits >= 3 ? CellProperty::kMore : static_cast<CellProperty>(visits);
}
constexpr std::string_view Name(CellProperty property) {
  constexpr std::array<std::string_view, kNumCellProperties> kNames = {
      "not covered", "covered once", "covered twice", "three times or more", "out of reach"};
  return kNames[static_cast<std::size_t>(property)];
}
constexpr Rgb ColourOf(CellProperty property) {
  constexpr std::array<Rgb, kNumCellProperties> kColours = {
      {{255, 255, 255}, {148, 212, 199}, {240, 170, 50}, {220, 60, 90}, {150, 154, 166}}};
  return kColours[static_cast<std::size_t>(property)];
}

// Of the robot and the circle of what it senses, its rolling window.
inline constexpr Rgb kWindowBlue = {0, 70, 210};

}  // namespace floorproof
