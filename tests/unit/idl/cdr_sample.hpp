#pragma once
#include <cstdint>
#include <cstring>
#include <random>
#include <string>
#include <vector>

#include "unit/idl/schema.hpp"

namespace coop::test {

using Bytes = std::vector<std::uint8_t>;

/// Writes a message with random content as little-endian plain CDR (OMG CORBA 3.3, part 2, 9.3;
/// XTypes 1.3, 7.4.1, version 1), from the schema alone and with none of the generated code: each
/// primitive value at a multiple of its size, counted from behind the four bytes of encapsulation;
/// strings and sequences behind a 32-bit length.
class CdrSample {
 public:
  CdrSample(const Schema& schema, std::uint32_t seed) : schema_(schema), random_(seed) {}

  Bytes operator()(const std::string& type) {
    bytes_ = {0x00, 0x01, 0x00, 0x00};
    write_message(type);
    return bytes_;
  }

 private:
  void write_message(const std::string& type) {
    for (const Field& field : schema_.at(type).fields) {
      std::size_t count = 1;
      if (field.array == "[]") {
        count = random_() % 4;
        write_number(static_cast<std::uint32_t>(count), 4);
      } else if (!field.array.empty()) {
        count = field.array_size();
      }
      for (std::size_t i = 0; i < count; ++i) write_value(field.type);
    }
  }

  void write_value(const std::string& type) {
    if (type.find('/') != std::string::npos) return write_message(type);
    if (type == "string") return write_string();
    if (type == "float64") {
      std::uint64_t bits = 0;
      const double value = std::uniform_real_distribution(-1e6, 1e6)(random_);
      std::memcpy(&bits, &value, sizeof bits);
      return write_number(bits, 8);
    }
    if (type == "float32") {
      std::uint32_t bits = 0;
      const float value = std::uniform_real_distribution(-1e3F, 1e3F)(random_);
      std::memcpy(&bits, &value, sizeof bits);
      return write_number(bits, 4);
    }
    if (type == "bool") return write_number(random_() % 2, 1);
    if (type.ends_with("int8")) return write_number(random_(), 1);
    if (type.ends_with("int32")) return write_number(random_(), 4);
    if (type.ends_with("int64")) return write_number(random_(), 8);
    throw std::runtime_error("no encoding for " + type);
  }

  void write_string() {
    const std::size_t length = random_() % 7;
    write_number(length + 1, 4);
    for (std::size_t i = 0; i < length; ++i) write_number('a' + random_() % 26, 1);
    write_number(0, 1);
  }

  void write_number(std::uint64_t value, std::size_t size) {
    while ((bytes_.size() - 4) % size != 0) bytes_.push_back(0);
    for (std::size_t i = 0; i < size; ++i) {
      bytes_.push_back(static_cast<std::uint8_t>(value >> (8 * i)));
    }
  }

  const Schema& schema_;
  std::mt19937_64 random_;
  Bytes bytes_;
};

}  // namespace coop::test
