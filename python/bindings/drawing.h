// SPDX-License-Identifier: Apache-2.0
// What it takes to draw inside a Python interpreter.
#pragma once

#include <mutex>
#include <utility>

#include "media/drawing_lock.h"
#include "media/media.h"
#include "python/bindings/arrays.h"
#include "python/bindings/host.h"

namespace floorproof {

template <class Draw>
auto DrawAlone(const Draw& draw) {
  return WithoutGil([&] {
    const std::lock_guard alone(Drawing());
    return draw();
  });
}

// [height, width, 3].
inline nb::ndarray<nb::numpy, std::uint8_t> ImageArray(Image image) {
  const auto height = static_cast<std::size_t>(image.height),
             width = static_cast<std::size_t>(image.width),
             channels = static_cast<std::size_t>(image.channels);
  return ArrayOf(std::move(image.data), {height, width, channels});
}

}  // namespace floorproof
