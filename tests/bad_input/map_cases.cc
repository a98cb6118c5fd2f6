// SPDX-License-Identifier: Apache-2.0
// ROS maps: their keys, and images that are not what they say.
#include "tests/bad_input/bad_input.h"

namespace floorproof {
namespace {

BadInput Keys(const std::string& name, const std::string& from, const std::string& to,
              std::vector<std::string> named) {
  return {name,
          {"plan", "scenario.yaml", "--out", "o"},
          {{"map.yaml", Replaced(GoodFiles().at("map.yaml"), from, to)}},
          std::move(named)};
}
BadInput Image(const std::string& name, const std::string& bytes, std::vector<std::string> named) {
  named.insert(named.begin(), "map.pgm");
  return {name, {"init", "map.yaml", "--out", "o"}, {{"map.pgm", bytes}}, std::move(named)};
}
std::string WithByte(const std::string& bytes, std::size_t at, char value) {
  return bytes.substr(0, at) + value + bytes.substr(at + 1);
}

}  // namespace

std::vector<BadInput> MapCases() {
  const std::string png = GoodPng(), bmp = GoodBmp(), pgm = GoodPgm();
  return {
      Keys("NoImage", "image: map.pgm\n", "", {"map.yaml: image", "missing"}),
      Keys("MisspeltResolution", "resolution", "resolutoin",
           {"map.yaml: resolution", "missing", "is resolutoin it"}),
      Keys("NoResolution", "resolution: 0.5", "resolution: 0", {"map.yaml:2: resolution = 0"}),
      Keys("NegativeResolution", "0.5", "-0.5", {"map.yaml:2: resolution = -0.5"}),
      Keys("ResolutionNotANumber", "0.5", ".nan", {"map.yaml:2: resolution = .nan"}),
      Keys("ResolutionOfKilometres", "0.5", "1000",
           {"map.yaml:2: resolution = 1000", "[1e-04, 100]"}),
      Keys("FloorTooLarge", "0.5", "100",
           {"map.yaml: resolution = 100", "800 m x 600 m", "192 million cells"}),
      Keys("FloorJustTooLarge", "0.5", "46", {"41 million cells", "at most 40 million"}),
      Keys("ShortOrigin", "[0.0, 0.0, 0.0]", "[0.0, 0.0]", {"map.yaml:3: origin", "[x, y, yaw]"}),
      Keys("FarOrigin", "[0.0, 0.0, 0.0]", "[1e9, 0.0, 0.0]", {"map.yaml:3: origin[0] = 1e9"}),
      Keys("NegateMaybe", "negate: 0", "negate: maybe",
           {"map.yaml:4: negate = maybe", "0, 1, true"}),
      Keys("ThresholdsTheWrongWayRound", "free_thresh: 0.196", "free_thresh: 0.9",
           {"map.yaml:6: free_thresh = 0.9", "at most occupied_thresh, 0.65"}),
      Keys("ThresholdAboveOne", "0.65", "65", {"map.yaml:5: occupied_thresh = 65", "[0, 1]"}),
      Keys("UnknownMode", "negate: 0", "mode: quaternary",
           {"map.yaml:4: mode = quaternary", "trinary"}),
      Keys("MissingImage", "map.pgm", "no.pgm", {"map.yaml:1: image = no.pgm", "no such file"}),
      Trusted(Keys(
          "ImageElsewhere", "map.pgm", "/no/such/folder/map.pgm",
          {"map.yaml:1: image = /no/such/folder/map.pgm", "no such file", "write image: map.pgm"})),
      Keys("ImageIsAFolder", "map.pgm", ".", {"map.yaml:1: image = ", "a folder"}),
      Trusted(Keys("ImageIsADevice", "map.pgm", "/dev/zero",
                   {"map.yaml:1: image = /dev/zero", "a device"})),
      Keys("ImageClimbsOut", "map.pgm", "maps/../../map.pgm",
           {"map.yaml:1: image = maps/../../map.pgm", "leaves its folder"}),
      Trusted(Keys("ImageIsText", "map.pgm", "../../../../../../../../etc/passwd",
                   {"etc/passwd", "is not an image"})),
      Image("AnEmptyImage", "", {"is empty"}),
      Image("AJpeg", "\xff\xd8\xff\xe0 JFIF", {"is not an image that can be read"}),
      Image("PgmLargerThanItsData", Replaced(pgm, "8 6", "80 60"), {"80 x 60", "69 bytes"}),
      Image("PgmCutShort", pgm.substr(0, pgm.size() - 1), {"8 x 6"}),
      Image("PgmOfTheHeaderAlone", "P5\n8 6\n", {"it ends before the largest value"}),
      Image("PgmOfHugeSize", Replaced(pgm, "8 6", "200000 200000"), {"200000 x 200000"}),
      Image("PgmBeyondAnyNumber", Replaced(pgm, "8 6", "99999999999999999999 6"),
            {"the width is more than"}),
      Image("PgmOfNoWidth", Replaced(pgm, "8 6", "0 6"), {"0 x 6"}),
      Image("PgmOfNegativeWidth", Replaced(pgm, "8 6", "-8 6"),
            {"no number where the width should be"}),
      Image("PgmWithoutGreys", Replaced(pgm, "255", "0"), {"the largest value must be > 0"}),
      Image("PgmWithTooManyGreys", Replaced(pgm, "255", "65536"),
            {"the largest value is more than 65535"}),
      Image("PlainPgmWithText", "P2 2 2 255 0 0 zero 0\n",
            {"no number where a pixel's value should be"}),
      Image("PlainPgmCutShort", "P2 3 2 255 0 0 0 0 0\n", {"3 x 2 pixels", "21 bytes"}),
      Image("PngOfHugeSize", PngOfSize(200'000, 200'000), {"200000 x 200000"}),
      Image("PngCutShort", png.substr(0, png.size() - 20), {"PNG is truncated within a chunk"}),
      Image("PngOfTheSignatureAlone", png.substr(0, 8), {"PNG is truncated within its header"}),
      Image("PngWithAWrongSum", WithByte(png, 60, 'x'), {"PNG is damaged: wrong checksum"}),
      Image("BmpCutShort", bmp.substr(0, bmp.size() - 10), {"8 x 6"}),
      Image("BmpOfHugeSize", WithByte(WithByte(bmp, 20, '\x03'), 24, '\x03'), {"196616 x 196614"}),
      Image("BmpOfTheHeaderAlone", bmp.substr(0, 20), {"BMP is truncated within its header"}),
      Image("BmpOfNegativeWidth", WithByte(bmp, 21, '\xff'), {"at least 1 x 1"}),
  };
}

}  // namespace floorproof
