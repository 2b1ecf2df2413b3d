#include "launcher/keys/permissions.hpp"

#include <ctime>
#include <string_view>

#include "runtime/topics.hpp"

namespace coop::keys {
namespace {

using Role = Participant::Role;

constexpr std::string_view kMaster = "master of time";
constexpr std::string_view kLockstep = "lockstep_";
/// Each follower has a topic of its own below it.
constexpr std::string_view kTick = "lockstep_tick";
constexpr const char* kEverything = "rt/*";
/// The component that hears everything, without being told what there is.
constexpr std::string_view kRecorder = "record";

std::string on_wire(std::string_view topic) {
  return "rt/" + std::string(topic);
}

/// Whether a list of programs names this participant.
bool concerns(std::string_view programs, const Participant& participant) {
  // The launcher and people are none of "all": those are the components.
  const bool names_all = runtime::lists(programs, "");
  if (participant.role == Role::kComponent || participant.role == Role::kObserver) {
    if (names_all) return true;
    if (participant.leads_time && runtime::lists(programs, kMaster)) return true;
  }
  return !names_all && runtime::lists(programs, participant.program);
}

void add_lockstep(const runtime::TopicInfo& topic, const Participant& participant, Rights& rights) {
  if (topic.name == kTick) {
    if (participant.leads_time) rights.publish.push_back(on_wire(kTick) + "/*");
    if (!participant.leads_time)
      rights.subscribe.push_back(on_wire(kTick) + "/" + participant.name);
    return;
  }
  if (concerns(topic.writers, participant)) rights.publish.push_back(on_wire(topic.name));
  if (concerns(topic.readers, participant)) rights.subscribe.push_back(on_wire(topic.name));
}

std::string to_xml(Date date) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(date);
  std::tm parts{};
  gmtime_r(&seconds, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%S", &parts);
  return text;
}

/// `kind` is publish or subscribe.
std::string rule_xml(const std::string& kind, const std::vector<std::string>& topics,
                     const std::string& robot) {
  if (topics.empty()) return {};
  std::string xml = "        <" + kind + ">\n          <topics>\n";
  for (const std::string& topic : topics) xml += "            <topic>" + topic + "</topic>\n";
  xml += "          </topics>\n";
  if (!robot.empty()) {
    xml += "          <partitions><partition>" + robot + "</partition></partitions>\n";
  }
  return xml + "        </" + kind + ">\n";
}

std::string domains_xml(const System& system) {
  return "<domains><id>" + std::to_string(system.domain) + "</id></domains>";
}

}  // namespace

Rights rights_of(const Participant& participant) {
  Rights rights;
  const bool hears_everything =
      participant.role == Role::kPerson || participant.role == Role::kObserver ||
      (participant.role == Role::kComponent && participant.program == kRecorder);
  for (const runtime::TopicInfo& topic : runtime::all_topics()) {
    if (topic.name.starts_with(kLockstep)) {
      if (participant.lockstep && participant.role == Role::kComponent) {
        add_lockstep(topic, participant, rights);
      }
      continue;
    }
    // Every program tells of its health; a health check asks with the component's own keys.
    const bool is_health = topic.qos == runtime::Qos::kHeartbeat;
    const bool may_write =
        is_health ? participant.role != Role::kLauncher
                  : participant.role != Role::kObserver && concerns(topic.writers, participant);
    const bool may_read = is_health || concerns(topic.readers, participant);
    if (may_write) rights.publish.push_back(on_wire(topic.name));
    if (may_read && !hears_everything) rights.subscribe.push_back(on_wire(topic.name));
  }
  if (hears_everything) rights.subscribe.emplace_back(kEverything);
  return rights;
}

std::string governance_xml(const System& system, Protection protection) {
  const std::string data = protection == Protection::kDiscovery ? "NONE" : "ENCRYPT";
  const std::string all = protection == Protection::kAll ? "ENCRYPT" : "NONE";
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<dds xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\"\n"
         "     xsi:noNamespaceSchemaLocation=\"omg_shared_ca_governance.xsd\">\n"
         "  <domain_access_rules>\n    <domain_rule>\n      " +
         domains_xml(system) +
         "\n"
         "      <allow_unauthenticated_participants>false</allow_unauthenticated_participants>\n"
         "      <enable_join_access_control>true</enable_join_access_control>\n"
         "      <discovery_protection_kind>ENCRYPT</discovery_protection_kind>\n"
         "      <liveliness_protection_kind>ENCRYPT</liveliness_protection_kind>\n"
         "      <rtps_protection_kind>" +
         all +
         "</rtps_protection_kind>\n"
         "      <topic_access_rules>\n        <topic_rule>\n"
         "          <topic_expression>*</topic_expression>\n"
         "          <enable_discovery_protection>true</enable_discovery_protection>\n"
         "          <enable_liveliness_protection>true</enable_liveliness_protection>\n"
         "          <enable_read_access_control>true</enable_read_access_control>\n"
         "          <enable_write_access_control>true</enable_write_access_control>\n"
         "          <metadata_protection_kind>" +
         all +
         "</metadata_protection_kind>\n"
         "          <data_protection_kind>" +
         data +
         "</data_protection_kind>\n"
         "        </topic_rule>\n      </topic_access_rules>\n"
         "    </domain_rule>\n  </domain_access_rules>\n</dds>\n";
}

std::string permissions_xml(const System& system, const std::string& name,
                            const std::string& subject, const Rights& rights, Date not_before,
                            Date not_after) {
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
         "<dds xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\"\n"
         "     xsi:noNamespaceSchemaLocation=\"omg_shared_ca_permissions.xsd\">\n"
         "  <permissions>\n    <grant name=\"" +
         name + "\">\n      <subject_name>" + subject +
         "</subject_name>\n"
         "      <validity><not_before>" +
         to_xml(not_before) + "</not_before><not_after>" + to_xml(not_after) +
         "</not_after></validity>\n      <allow_rule>\n        " + domains_xml(system) + "\n" +
         rule_xml("publish", rights.publish, system.robot) +
         rule_xml("subscribe", rights.subscribe, system.robot) +
         "      </allow_rule>\n      <default>DENY</default>\n    </grant>\n"
         "  </permissions>\n</dds>\n";
}

}  // namespace coop::keys
