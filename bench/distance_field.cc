// SPDX-License-Identifier: Apache-2.0
// What a field of shortest distances at any angle costs: floors of about 2000 cells a side, without
// anything on them, with rooms, doors and furniture, and real maps that are drawn on so many cells.
// Milliseconds of one core a field, the median of several sources; how often a place was reached;
// bytes a cell. Then a thousand fields on two threads.
//   bench_distance_field [MAP.pgm ...] [--fields COUNT] [--write FOLDER]
// --fields: instead of a thousand. --write: for bench/peer_mcp.py, the floors as PGM files (0:
// blocked), and of each source its cell and the sum of the distances.
#include <fmt/core.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <fstream>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#include "base/streams.h"
#include "bench/cpu_time.h"
#include "planners/search/any_angle_field.h"

namespace floorproof {
namespace {

using Cells = Grid<std::uint8_t>;

double Seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void Fill(Cells& free, int x, int y, int w, int h, std::uint8_t value) {
  for (int iy = std::max(0, y); iy < std::min(free.height, y + h); ++iy)
    for (int ix = std::max(0, x); ix < std::min(free.width, x + w); ++ix) free(ix, iy) = value;
}

// One cell in a hundred is blocked: 40,000 obstacles, the worst that a map may bring.
Cells Specks(int side) {
  Cells free(side, side, 1);
  Stream random(1, 0, "specks");
  for (std::uint8_t& cell : free.cells) cell = random.Uniform() >= 0.01;
  return free;
}

// Rooms of 320 x 400 cells with doors of 20, furniture of 4 to 30 cells and specks of 2 to 5.
Cells Rooms(int side) {
  Cells free(side, side, 1);
  Stream random(1, 0, "rooms");
  const auto below = [&](int n) {
    return static_cast<int>(random.Below(static_cast<std::uint64_t>(n)));
  };
  for (int i = 0; i < 600; ++i)
    Fill(free, below(side), below(side), 4 + below(26), 4 + below(26), 0);
  for (int i = 0; i < 900; ++i) Fill(free, below(side), below(side), 2 + below(4), 2 + below(4), 0);
  for (int x = 320; x + 100 < side; x += 320) Fill(free, x, 0, 4, side, 0);
  for (int y = 400; y + 100 < side; y += 400) Fill(free, 0, y, side, 4, 0);
  for (int x = 320; x + 100 < side; x += 320)
    for (int y = 0; y < side; y += 400) Fill(free, x - 6, y + 60 + below(260), 16, 20, 1);
  for (int y = 400; y + 100 < side; y += 400)
    for (int x = 0; x < side; x += 320) Fill(free, x + 40 + below(200), y - 6, 20, 16, 1);
  return free;
}

// The free cells of a map of 8 bits (P5), each drawn as k x k cells so that the wider side has
// about `side`; away from what is not free by `away` cells in both directions.
Cells ReadMap(const std::string& path, int side, int away) {
  std::ifstream in(path, std::ios::binary);
  std::string magic;
  int width = 0, height = 0, most = 0;
  in >> magic;
  for (int* value : {&width, &height, &most}) {
    while (in >> std::ws && in.peek() == '#') in.ignore(1 << 20, '\n');
    in >> *value;
  }
  in.get();
  std::string pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), '\0');
  if (magic != "P5" || most > 255 ||
      !in.read(pixels.data(), static_cast<std::streamsize>(pixels.size())))
    return {};
  const int k = std::max(1, (side + std::max(width, height) / 2) / std::max(width, height));
  Cells free(width * k, height * k, 1);
  for (int iy = 0; iy < height; ++iy)
    for (int ix = 0; ix < width; ++ix)
      if (static_cast<unsigned char>(pixels[Z(height - 1 - iy) * Z(width) + Z(ix)]) < 250)
        Fill(free, ix * k - away, iy * k - away, k + 2 * away, k + 2 * away, 0);
  return free;
}

// Free cells, drawn at random, of the largest area that is connected as far as the field says.
std::vector<Cell> Sources(const Cells& free, const AnyAngleFloor& floor, int count) {
  AnyAngleField field(floor);
  Stream random(2, 0, "sources");
  const auto draw = [&] {
    for (;;) {
      const Cell c = CellAt(free, random.Below(free.cells.size()));
      if (free(c)) return c;
    }
  };
  Cell best;
  int most = -1;
  for (int i = 0; i < 5; ++i) {
    const Cell c = draw();
    field.From(c);
    int reached = 0;
    for (int k = 0; k < 200; ++k)
      reached += !std::isinf(field.DistanceTo(CellAt(free, free.cells.size() / 200 * Z(k))));
    if (reached > most) most = reached, best = c;
  }
  field.From(best);
  std::vector<Cell> sources;
  while (static_cast<int>(sources.size()) < count)
    if (const Cell c = draw(); !std::isinf(field.DistanceTo(c))) sources.push_back(c);
  return sources;
}

// Of all places in reach, the sum; `reached`: how many there are.
double SumOfDistances(const Cells& free, const AnyAngleField& field, std::int64_t& reached) {
  double sum = 0;
  reached = 0;
  for (std::size_t i = 0; i < free.cells.size(); ++i)
    if (const double d = field.DistanceTo(CellAt(free, i)); !std::isinf(d)) ++reached, sum += d;
  return sum;
}

void Measure(const std::string& name, const Cells& free, const std::string& folder) {
  const double begin = CpuSeconds();
  const AnyAngleFloor floor(free);
  const double built = CpuSeconds() - begin;
  AnyAngleField field(floor);
  std::vector<double> seconds, times;
  std::int64_t reached = 0;
  std::string list;
  for (const Cell source : Sources(free, floor, 15)) {
    const double start = CpuSeconds();
    field.From(source);
    seconds.push_back(CpuSeconds() - start);
    const double sum = SumOfDistances(free, field, reached);
    times.push_back(static_cast<double>(field.work()) / static_cast<double>(reached));
    list += fmt::format("{} {} {}\n", source.ix, source.iy, sum);
  }
  std::sort(seconds.begin(), seconds.end());
  std::sort(times.begin(), times.end());
  fmt::print("{:22} {:5} x {:4} {:5.2f} {:8.1f} {:8.1f} {:8.1f} {:7.2f} {:7.1f}\n", name,
             free.width, free.height, 1e-6 * static_cast<double>(reached), 1e3 * built,
             1e3 * seconds[seconds.size() / 2], 1e3 * seconds.back(), times[times.size() / 2],
             static_cast<double>(field.bytes()) / static_cast<double>(free.cells.size()));
  std::cout.flush();
  if (folder.empty()) return;
  std::ofstream pgm(folder + "/" + name + ".pgm", std::ios::binary);
  pgm << "P5\n" << free.width << " " << free.height << "\n1\n";
  pgm.write(reinterpret_cast<const char*>(free.cells.data()),
            static_cast<std::streamsize>(free.cells.size()));
  std::ofstream(folder + "/" + name + ".txt") << list;
}

void MeasureThreads(const Cells& free, int fields) {
  const AnyAngleFloor floor(free);
  const std::vector<Cell> sources = Sources(free, floor, fields);
  const double start = Seconds();
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    AnyAngleField field(floor);
    for (std::size_t i; (i = next++) < sources.size();) field.From(sources[i]);
  };
  std::thread other(work);
  work();
  other.join();
  fmt::print("{} fields of rooms on 2 threads: {:.1f} s\n", fields, Seconds() - start);
}

int Main(int argc, char** argv) {
  std::vector<std::string> maps;
  std::string folder;
  int fields = 1000;
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]) == "--write" && i + 1 < argc)
      folder = argv[++i];
    else if (std::string(argv[i]) == "--fields" && i + 1 < argc)
      fields = std::stoi(argv[++i]);
    else
      maps.emplace_back(argv[i]);
  }
  fmt::print("{:22} {:>12} {:>5} {:>8} {:>8} {:>8} {:>7} {:>7}\n", "floor", "cells", "mill.",
             "floor_ms", "ms", "most_ms", "times", "bytes");
  Measure("free", Cells(2000, 2000, 1), folder);
  Measure("specks", Specks(2000), folder);
  const Cells rooms = Rooms(2000);
  Measure("rooms", rooms, folder);
  for (const std::string& map : maps) {
    const Cells free = ReadMap(map, 2000, 3);
    if (free.cells.empty()) continue;
    const std::size_t end = map.find_last_of('/'), begin = map.find_last_of('/', end - 1) + 1;
    Measure(map.substr(begin, end - begin), free, folder);
  }
  if (fields > 0) MeasureThreads(rooms, fields);
  return 0;
}

}  // namespace
}  // namespace floorproof

int main(int argc, char** argv) { return floorproof::Main(argc, argv); }
