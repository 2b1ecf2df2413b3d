#pragma once
#include <cstdio>
#include <string>
#include <vector>

#include "capture/schema/cdr_walk.hpp"

namespace coop::test {

/// Every value of a message, a line each: "scan ranges[3] 1.25", numbers with all the digits of a
/// double.
class ValueLines {
 public:
  explicit ValueLines(std::string topic) : topic_(std::move(topic)) {}

  void begin_message(const capture::FieldLayout& field, std::size_t index) {
    prefixes_.push_back(prefixes_.back() + named(field, index) + ".");
  }
  void end_message(const capture::FieldLayout& /*field*/) { prefixes_.pop_back(); }
  void begin_array(const capture::FieldLayout& /*field*/, std::size_t /*count*/) {}
  void end_array(const capture::FieldLayout& /*field*/) {}
  void text(const capture::FieldLayout& field, std::size_t index, std::string_view value) {
    add(field, index, std::string(value));
  }
  void number(const capture::FieldLayout& field, const capture::Number& value) {
    add(field, capture::kNoIndex, digits(value));
  }
  void numbers(const capture::FieldLayout& field, const capture::NumberArray& values) {
    for (std::size_t i = 0; i < values.size(); ++i) add(field, i, digits(values[i]));
  }

  [[nodiscard]] std::vector<std::string> lines() && { return std::move(lines_); }

 private:
  static std::string named(const capture::FieldLayout& field, std::size_t index) {
    return index == capture::kNoIndex ? field.name : field.name + "[" + std::to_string(index) + "]";
  }
  static std::string digits(const capture::Number& value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.17g", value.as_double());
    return text;
  }
  void add(const capture::FieldLayout& field, std::size_t index, const std::string& value) {
    lines_.push_back(topic_ + " " + prefixes_.back() + named(field, index) + " " + value);
  }

  std::string topic_;
  std::vector<std::string> prefixes_{""};
  std::vector<std::string> lines_;
};

}  // namespace coop::test
