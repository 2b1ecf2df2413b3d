#include "capture/schema/csv_columns.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "unit/capture_schema/cdr_bytes.hpp"

namespace coop::capture {
namespace {

using test::CdrBytes;
using ::testing::ElementsAre;

const MessageLayout& table_layout() {
  static const MessageLayout kLayout("p/M",
                                     "Inner[] list\nuint8[2] pair\nstring[] words\nInner one\n"
                                     "===\nMSG: p/Inner\nstring name\nint16[] data\n");
  return kLayout;
}

CdrBytes table_message(int elements, int data) {
  CdrBytes bytes;
  const auto inner = [&](int i) {
    bytes.text("n" + std::to_string(i)).length(static_cast<std::uint32_t>(data));
    for (int k = 0; k < data; ++k) bytes.put(static_cast<std::int16_t>(10 * i + k));
  };
  bytes.length(static_cast<std::uint32_t>(elements));
  for (int i = 0; i < elements; ++i) inner(i);
  bytes.put(std::uint8_t{7}).put(std::uint8_t{8});
  bytes.length(static_cast<std::uint32_t>(elements));
  for (int i = 0; i < elements; ++i) bytes.text("w" + std::to_string(i));
  inner(9);
  return bytes;
}

TEST(CsvColumns, arrays_have_the_columns_of_the_longest_message) {
  CsvColumns columns(table_layout(), {});
  const auto narrow = table_message(1, 1);
  const auto wide = table_message(2, 2);
  ASSERT_TRUE(columns.measure(narrow));
  ASSERT_TRUE(columns.measure(wide));
  columns.settle();
  EXPECT_THAT(columns.names(),
              ElementsAre("list[0].name", "list[0].data[0]", "list[0].data[1]", "list[1].name",
                          "list[1].data[0]", "list[1].data[1]", "pair[0]", "pair[1]", "words[0]",
                          "words[1]", "one.name", "one.data[0]", "one.data[1]"));
  EXPECT_THAT(**columns.row(wide), ElementsAre("n0", "0", "1", "n1", "10", "11", "7", "8", "w0",
                                               "w1", "n9", "90", "91"));
  EXPECT_THAT(**columns.row(narrow),
              ElementsAre("n0", "0", "", "", "", "", "7", "8", "w0", "", "n9", "90", ""));
}

TEST(CsvColumns, long_arrays_are_shortened_and_their_length_told) {
  CsvColumns columns(table_layout(), {.max_elements = 1});
  const auto wide = table_message(3, 2);
  ASSERT_TRUE(columns.measure(wide));
  columns.settle();
  EXPECT_THAT(columns.names(),
              ElementsAre("list[0].name", "list[0].data[0]", "list[0].data.length", "list.length",
                          "pair[0]", "pair.length", "words[0]", "words.length", "one.name",
                          "one.data[0]", "one.data.length"));
  EXPECT_THAT(**columns.row(wide),
              ElementsAre("n0", "0", "2", "3", "7", "2", "w0", "3", "n9", "90", "2"));
}

TEST(CsvColumns, no_messages_give_the_columns_that_do_not_depend_on_them) {
  CsvColumns columns(table_layout(), {});
  columns.settle();
  EXPECT_THAT(columns.names(), ElementsAre("one.name"));
}

TEST(CsvColumns, a_malformed_message_is_an_error) {
  CsvColumns columns(table_layout(), {});
  auto bytes = table_message(1, 2);
  bytes.bytes().resize(20);
  EXPECT_EQ(columns.measure(bytes).error().path, "list[0].data");
}

TEST(CsvColumns, a_table_wider_than_anybody_reads_is_refused) {
  const MessageLayout wide("p/M", "Inner[] a\n===\nMSG: p/Inner\nuint8[] b\n");
  CsvColumns columns(wide, {});
  CdrBytes bytes;
  bytes.length(1500).length(1500);
  for (int i = 0; i < 1500; ++i) bytes.put(std::uint8_t{1});
  for (int i = 1; i < 1500; ++i) bytes.length(0);
  ASSERT_TRUE(columns.measure(bytes));
  EXPECT_THROW(columns.settle(), DefinitionError);
}

}  // namespace
}  // namespace coop::capture
