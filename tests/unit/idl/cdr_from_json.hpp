#pragma once
#include <bit>
#include <limits>
#include <nlohmann/json.hpp>

#include "unit/idl/cdr_sample.hpp"

namespace coop::test {

/// Writes a message from its values in JSON as little-endian plain CDR, from the IDL's text alone:
/// what a decoder's output must give to have lost nothing.
class CdrFromJson {
 public:
  explicit CdrFromJson(const Schema& schema) : schema_(schema) {}

  Bytes operator()(const std::string& type, const nlohmann::json& message) {
    bytes_ = {0x00, 0x01, 0x00, 0x00};
    put_message(type, message);
    return bytes_;
  }

 private:
  using Json = nlohmann::json;

  void put_message(const std::string& type, const Json& message) {
    const auto& fields = schema_.at(type).fields;
    if (message.size() != fields.size()) throw std::runtime_error("other fields than " + type);
    for (const Field& field : fields) {
      const Json& value = message.at(field.name);
      if (field.array.empty()) {
        put(field.type, value);
        continue;
      }
      if (field.array == "[]") {
        put_bits(value.size(), 4);
      } else if (value.size() != field.array_size()) {
        throw std::runtime_error("another length of " + field.name);
      }
      for (const Json& element : value) put(field.type, element);
    }
  }

  void put(const std::string& type, const Json& value) {
    if (type.find('/') != std::string::npos) return put_message(type, value);
    if (type == "string") {
      const auto text = value.get<std::string>();
      put_bits(text.size() + 1, 4);
      for (const char c : text) put_bits(static_cast<std::uint8_t>(c), 1);
      return put_bits(0, 1);
    }
    if (type == "bool") return put_bits(value.get<bool>() ? 1 : 0, 1);
    if (type == "float64") return put_bits(std::bit_cast<std::uint64_t>(number(value)), 8);
    if (type == "float32") {
      return put_bits(std::bit_cast<std::uint32_t>(static_cast<float>(number(value))), 4);
    }
    const std::size_t size = std::stoul(type.substr(type.find_first_of("0123456789"))) / 8;
    put_bits(value.is_number_unsigned() ? value.get<std::uint64_t>()
                                        : static_cast<std::uint64_t>(value.get<std::int64_t>()),
             size);
  }

  static double number(const Json& value) {
    if (value.is_number()) return value.get<double>();
    if (value == "NaN") return std::numeric_limits<double>::quiet_NaN();
    const double infinity = std::numeric_limits<double>::infinity();
    if (value == "Infinity") return infinity;
    if (value == "-Infinity") return -infinity;
    throw std::runtime_error("no number: " + value.dump());
  }

  void put_bits(std::uint64_t bits, std::size_t size) {
    while ((bytes_.size() - 4) % size != 0) bytes_.push_back(0);
    for (std::size_t i = 0; i < size; ++i) {
      bytes_.push_back(static_cast<std::uint8_t>(bits >> (8 * i)));
    }
  }

  const Schema& schema_;
  Bytes bytes_;
};

}  // namespace coop::test
