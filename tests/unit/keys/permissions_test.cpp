#include "launcher/keys/permissions.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace coop::keys {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

Rights of(const std::string& program, Participant::Role role = Participant::Role::kComponent) {
  return rights_of({.name = program, .program = program, .role = role});
}

TEST(PermissionsTest, a_driver_publishes_its_data_and_its_health_and_no_more) {
  const Rights lidar = of("lidar_driver");
  EXPECT_THAT(lidar.publish, ElementsAre("rt/component_status", "rt/scan", "rt/tf_static"));
  EXPECT_THAT(lidar.subscribe, Contains("rt/ground_truth"));
  EXPECT_THAT(lidar.subscribe, Contains("rt/clock"));
  EXPECT_THAT(lidar.subscribe, Not(Contains("rt/cmd_vel")));
}

TEST(PermissionsTest, a_program_nobody_knows_has_what_concerns_all) {
  EXPECT_THAT(of("stranger").publish, ElementsAre("rt/component_status"));
}

TEST(PermissionsTest, the_launcher_watches_and_stops_and_does_no_more) {
  const Rights launcher = of("launcher", Participant::Role::kLauncher);
  EXPECT_THAT(launcher.publish, ElementsAre("rt/emergency_stop"));
  EXPECT_THAT(launcher.subscribe,
              ElementsAre("rt/component_status", "rt/mission_status", "rt/odom"));
}

TEST(PermissionsTest, a_person_commands_and_an_observer_only_hears) {
  const Rights person = of("person", Participant::Role::kPerson);
  EXPECT_THAT(person.publish, Contains("rt/emergency_stop"));
  EXPECT_THAT(person.publish, Not(Contains("rt/cmd_vel")));
  EXPECT_THAT(person.subscribe, Contains("rt/*"));
  const Rights recorder = of("recorder", Participant::Role::kObserver);
  EXPECT_THAT(recorder.publish, ElementsAre("rt/component_status"));
  EXPECT_THAT(recorder.subscribe, Contains("rt/*"));
}

TEST(PermissionsTest, the_recorder_of_a_system_hears_everything_and_commands_nothing) {
  const Rights recorder = of("record");
  EXPECT_THAT(recorder.publish, ElementsAre("rt/component_status", "rt/save_capture_result"));
  EXPECT_THAT(recorder.subscribe, ElementsAre("rt/*"));
}

TEST(PermissionsTest, topics_of_lockstep_are_open_in_lockstep_only) {
  EXPECT_THAT(of("dwa").publish, Not(Contains("rt/lockstep_done")));
  const Rights dwa = rights_of({.name = "dwa", .program = "dwa", .lockstep = true});
  EXPECT_THAT(dwa.publish, Contains("rt/lockstep_done"));
  EXPECT_THAT(dwa.subscribe, Contains("rt/lockstep_tick/dwa"));
  EXPECT_THAT(dwa.publish, Not(Contains("rt/lockstep_roster")));
  const Rights master = rights_of(
      {.name = "simulator", .program = "simulator", .lockstep = true, .leads_time = true});
  EXPECT_THAT(master.publish, Contains("rt/lockstep_tick/*"));
  EXPECT_THAT(master.publish, Contains("rt/lockstep_roster"));
  EXPECT_THAT(master.subscribe, Contains("rt/lockstep_done"));
}

TEST(PermissionsTest, permissions_hold_for_one_domain_and_one_robot) {
  const Date day = std::chrono::sys_days(std::chrono::year(2026) / 3 / 1);
  const std::string xml =
      permissions_xml({.domain = 7, .robot = "ducky"}, "amcl", "CN=amcl,O=Coop",
                      {.publish = {"rt/map"}, .subscribe = {}}, day, day + std::chrono::days(2));
  EXPECT_THAT(xml, HasSubstr("<domains><id>7</id></domains>"));
  EXPECT_THAT(xml, HasSubstr("<partitions><partition>ducky</partition></partitions>"));
  EXPECT_THAT(xml, HasSubstr("<not_after>2026-03-03T00:00:00</not_after>"));
  EXPECT_THAT(xml, HasSubstr("<subject_name>CN=amcl,O=Coop</subject_name>"));
  EXPECT_THAT(xml, Not(HasSubstr("<subscribe>")));
  EXPECT_THAT(xml, HasSubstr("<default>DENY</default>"));
}

}  // namespace
}  // namespace coop::keys
