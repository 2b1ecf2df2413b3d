#include "core/csv.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace coop {
namespace {

TEST(Csv, fields_that_need_it_are_quoted_and_come_back) {
  const std::vector<std::string> fields{"plain", "a,b", "say \"no\"", "", "two\nlines"};
  const std::string line = csv_line(fields);
  EXPECT_EQ(line, "plain,\"a,b\",\"say \"\"no\"\"\",,\"two\nlines\"\n");
  const CsvTable table = parse_csv("1,2,3,4,5\n" + line);
  ASSERT_EQ(table.rows.size(), 1U);
  EXPECT_EQ(table.rows[0], fields);
}

TEST(Csv, a_column_is_found_by_name_or_named_in_the_complaint) {
  const CsvTable table = parse_csv("seed,path\n1,2.5\n");
  EXPECT_EQ(table.column("path"), 1U);
  EXPECT_THROW((void)table.column("paths"), std::runtime_error);
}

TEST(Csv, a_line_its_writer_did_not_finish_is_left_out) {
  EXPECT_EQ(parse_csv("a,b\n1,2\n3,").rows.size(), 1U);
}

TEST(Csv, a_row_of_another_length_is_refused) {
  EXPECT_THROW((void)parse_csv("a,b\n1\n"), std::runtime_error);
}

TEST(Csv, a_quote_left_open_is_refused) {
  EXPECT_THROW((void)parse_csv("a\n\"b\n"), std::runtime_error);
}

TEST(Csv, nothing_is_an_empty_table) {
  EXPECT_TRUE(parse_csv("").columns.empty());
}

}  // namespace
}  // namespace coop
