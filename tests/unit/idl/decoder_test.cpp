// Messages serialised by the generated types, decoded by nothing but the text of their definition.
#include <gtest/gtest.h>

#include "capture/schema/csv_columns.hpp"
#include "capture/schema/definitions.hpp"
#include "capture/schema/message_text.hpp"
#include "capture/schema/payload_difference.hpp"
#include "idl_headers.hpp"
#include "idl_lists.hpp"
#include "unit/idl/cdr_from_json.hpp"
#include "unit/idl/fast_cdr.hpp"

namespace coop::test {
namespace {

using capture::MessageLayout;

const Schema& idl_schema() {
  static const Schema kSchema = load_idl(std::filesystem::path(COOP_SOURCE_DIR) / "idl");
  return kSchema;
}

MessageLayout layout_of(const std::string& type) {
  return {type, *capture::ros2msg_definition(type)};
}

template <class T>
Bytes random_message(const std::string& type, std::uint32_t seed) {
  return reencode<T>(CdrSample(idl_schema(), seed)(type));
}

std::string as_json(const MessageLayout& layout, const Bytes& bytes) {
  std::string text;
  const auto read = capture::append_json(layout, std::as_bytes(std::span(bytes)), {}, text);
  EXPECT_TRUE(read) << layout.name() << ": " << read.error().text();
  return text;
}

template <class T>
void expect_every_field_is_decoded(const std::string& type) {
  const MessageLayout layout = layout_of(type);
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    const Bytes bytes = random_message<T>(type, seed);
    const std::string text = as_json(layout, bytes);
    EXPECT_EQ(CdrFromJson(idl_schema())(type, nlohmann::json::parse(text)), bytes) << text;
  }
}

TEST(Decoder, every_field_of_every_type_has_the_value_that_was_serialised) {
#define COOP_CHECK(package, type) \
  expect_every_field_is_decoded<package::msg::type>(#package "/" #type);
  COOP_IDL_TYPES(COOP_CHECK)
#undef COOP_CHECK
}

/// One column of a table for each value in JSON, in the same order.
void collect(const nlohmann::ordered_json& value, std::vector<std::string>& out) {
  if (value.is_structured()) {
    for (const auto& element : value) collect(element, out);
  } else {
    out.push_back(value.is_string() ? value.get<std::string>() : value.dump());
  }
}

template <class T>
void expect_a_row_of_all_values(const std::string& type) {
  const MessageLayout layout = layout_of(type);
  const Bytes bytes = random_message<T>(type, 3);
  const auto payload = std::as_bytes(std::span(bytes));
  capture::CsvColumns columns(layout, {});
  ASSERT_TRUE(columns.measure(payload));
  columns.settle();
  const auto row = columns.row(payload);
  ASSERT_TRUE(row);
  std::vector<std::string> values;
  collect(nlohmann::ordered_json::parse(as_json(layout, bytes)), values);
  const auto filled = std::ranges::count_if(**row, [](const auto& cell) { return !cell.empty(); });
  const auto texts =
      std::ranges::count_if(values, [](const auto& value) { return !value.empty(); });
  EXPECT_EQ(filled, texts) << type;
  EXPECT_EQ((*row)->size(), columns.names().size()) << type;
}

TEST(Decoder, every_type_has_a_row_of_all_its_values) {
#define COOP_CHECK(package, type) \
  expect_a_row_of_all_values<package::msg::type>(#package "/" #type);
  COOP_IDL_TYPES(COOP_CHECK)
#undef COOP_CHECK
}

template <class T>
void expect_every_changed_byte_is_no_crash(const std::string& type) {
  const MessageLayout layout = layout_of(type);
  const Bytes bytes = random_message<T>(type, 5);
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    Bytes changed = bytes;
    changed[i] = static_cast<std::uint8_t>(changed[i] ^ 0xFFU);
    std::string text;
    const auto payload = std::as_bytes(std::span(changed));
    const auto read = capture::append_json(layout, payload, {}, text);
    if (read) {
      EXPECT_TRUE(nlohmann::json::accept(text)) << text;
    }
    const auto difference =
        capture::first_difference(layout, std::as_bytes(std::span(bytes)), payload);
    if (!read) {
      EXPECT_TRUE(!difference || *difference) << type << " byte " << i;
    }
  }
}

TEST(Decoder, a_changed_byte_anywhere_gives_valid_text_or_an_error) {
#define COOP_CHECK(package, type) \
  expect_every_changed_byte_is_no_crash<package::msg::type>(#package "/" #type);
  COOP_IDL_TYPES(COOP_CHECK)
#undef COOP_CHECK
}

}  // namespace
}  // namespace coop::test
