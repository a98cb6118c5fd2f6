// SPDX-License-Identifier: Apache-2.0
#include "run/episode/bounded_json.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <vector>

namespace floorproof {
namespace {

using Json = nlohmann::json;

// Counts while the parser runs; nothing is built. A callback that returns false stops the parser.
class LimitedParse final : public nlohmann::json_sax<Json> {
 public:
  explicit LimitedParse(const JsonLimits& limits) : limits_(limits) {}
  const std::string& why() const { return why_; }

  bool start_object(std::size_t) override { return Enter(); }
  bool start_array(std::size_t) override { return Enter(); }
  bool end_object() override { return Leave(); }
  bool end_array() override { return Leave(); }
  bool key(string_t&) override {
    if (++keys_.back() <= limits_.keys) return true;
    why_ = fmt::format("holds a JSON object of more than {} keys", limits_.keys);
    return false;
  }
  bool parse_error(std::size_t, const std::string&, const Json::exception&) override {
    why_ = "is no JSON";
    return false;
  }
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(number_integer_t) override { return true; }
  bool number_unsigned(number_unsigned_t) override { return true; }
  bool number_float(number_float_t, const string_t&) override { return true; }
  bool string(string_t&) override { return true; }
  bool binary(binary_t&) override { return true; }

 private:
  bool Enter() {
    keys_.push_back(0);
    if (keys_.size() <= limits_.levels) return true;
    why_ = fmt::format("is JSON nested more than {} levels deep", limits_.levels);
    return false;
  }
  bool Leave() {
    keys_.pop_back();
    return true;
  }

  const JsonLimits& limits_;
  std::vector<std::size_t> keys_;  // of the objects that are open
  std::string why_;
};

}  // namespace

std::string WhyUnboundedJson(std::string_view text, const JsonLimits& limits) {
  if (text.size() > limits.bytes)
    return fmt::format("is JSON of more than {} MiB", limits.bytes >> 20);
  LimitedParse parse(limits);
  Json::sax_parse(text, &parse);
  return parse.why();
}

}  // namespace floorproof
