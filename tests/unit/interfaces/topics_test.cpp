// The table of topics: consistent in itself, with the IDL, and with the page made from it.
#include "runtime/topics.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <vector>

#include "runtime/interfaces/markdown.hpp"

namespace coop::runtime {
namespace {

std::set<std::string> idl_messages() {
  std::set<std::string> messages;
  std::istringstream list(COOP_IDL_MESSAGES);
  for (std::string message; std::getline(list, message, ',');) messages.insert(message);
  return messages;
}

TEST(Topics, every_topic_is_found_by_its_name_and_no_other_is) {
  for (const TopicInfo& topic : all_topics()) EXPECT_EQ(find_topic(topic.name), &topic);
  EXPECT_EQ(find_topic("scann"), nullptr);
  EXPECT_EQ(find_topic(""), nullptr);
  EXPECT_EQ(find_topic("zzz"), nullptr);
}

TEST(Topics, the_types_of_topics_are_exactly_those_with_topic_support) {
  std::set<std::string> used;
  for (const TopicInfo& topic : all_topics()) used.insert(std::string(topic.type));
  EXPECT_EQ(used, idl_messages());
}

TEST(Topics, every_topic_has_somebody_who_writes_somebody_who_reads_and_a_line_about_it) {
  for (const TopicInfo& topic : all_topics()) {
    EXPECT_FALSE(topic.writers.empty()) << topic.name;
    EXPECT_FALSE(topic.readers.empty()) << topic.name;
    EXPECT_FALSE(topic.about.empty()) << topic.name;
  }
}

TEST(Topics, names_of_types_on_the_wire_follow_ros2) {
  EXPECT_EQ(dds_type_name("sensor_msgs/LaserScan"), "sensor_msgs::msg::dds_::LaserScan_");
}

TEST(Topics, a_program_is_found_in_a_list_as_a_whole_word) {
  EXPECT_TRUE(lists("amcl, slam", "amcl"));
  EXPECT_TRUE(lists("amcl, slam", "slam"));
  EXPECT_FALSE(lists("amcl, slam", "am"));
  EXPECT_FALSE(lists("amcl, slam", "lam"));
  EXPECT_FALSE(lists("", "slam"));
  EXPECT_TRUE(lists("all", "slam"));
}

TEST(Topics, the_page_of_interfaces_is_what_the_generator_writes) {
  std::ifstream file(std::filesystem::path(COOP_SOURCE_DIR) / "docs/interfaces.md");
  ASSERT_TRUE(file) << "docs/interfaces.md is missing";
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(page, interfaces_markdown())
      << "run the program interfaces_doc and put its output into docs/interfaces.md";
}

}  // namespace
}  // namespace coop::runtime
