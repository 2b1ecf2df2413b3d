#include "launcher/control_protocol.hpp"

#include <nlohmann/json.hpp>

#include "core/runtime_folder.hpp"

namespace coop::launcher {
namespace {

using Json = nlohmann::json;

/// Details come from components: whatever bytes they are, the answer stays valid JSON.
std::string dump(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json to_json(const Row& row) {
  return {{"name", row.name},         {"state", row.state},       {"pid", row.pid},
          {"uptime", row.uptime},     {"restarts", row.restarts}, {"cpu", row.cpu},
          {"resident", row.resident}, {"detail", row.detail}};
}

Row row_from_json(const Json& json) {
  Row row;
  json.at("name").get_to(row.name);
  json.at("state").get_to(row.state);
  json.at("pid").get_to(row.pid);
  json.at("uptime").get_to(row.uptime);
  json.at("restarts").get_to(row.restarts);
  json.at("cpu").get_to(row.cpu);
  json.at("resident").get_to(row.resident);
  json.at("detail").get_to(row.detail);
  return row;
}

Json to_json(const SystemView& system) {
  Json rows = Json::array();
  for (const Row& row : system.rows) rows.push_back(to_json(row));
  return {{"robot", system.robot},           {"domain", system.domain},
          {"launcher", system.launcher},     {"launch_file", system.launch_file},
          {"run_folder", system.run_folder}, {"uptime", system.uptime},
          {"components", std::move(rows)}};
}

SystemView system_from_json(const Json& json) {
  SystemView system;
  json.at("robot").get_to(system.robot);
  json.at("domain").get_to(system.domain);
  json.at("launcher").get_to(system.launcher);
  json.at("launch_file").get_to(system.launch_file);
  json.at("run_folder").get_to(system.run_folder);
  json.at("uptime").get_to(system.uptime);
  for (const Json& row : json.at("components")) system.rows.push_back(row_from_json(row));
  return system;
}

}  // namespace

std::string encode(const ControlRequest& request) {
  Json json{{"verb", request.verb}};
  if (!request.name.empty()) json["name"] = request.name;
  return dump(json);
}

std::string encode(const ControlReply& reply) {
  Json json{{"ok", reply.ok}};
  if (!reply.ok) json["error"] = reply.error;
  if (reply.system.launcher != 0) json["system"] = to_json(reply.system);
  return dump(json);
}

Result<ControlRequest> decode_request(std::string_view line) {
  try {
    const Json json = Json::parse(line);
    return ControlRequest{json.at("verb").get<std::string>(), json.value("name", std::string{})};
  } catch (const Json::exception&) {
    return fail(R"(expected {"verb": ..., "name": ...} as one line of JSON)");
  }
}

Result<ControlReply> decode_reply(std::string_view line) {
  try {
    const Json json = Json::parse(line);
    ControlReply reply;
    json.at("ok").get_to(reply.ok);
    reply.error = json.value("error", std::string{});
    if (json.contains("system")) reply.system = system_from_json(json["system"]);
    return reply;
  } catch (const Json::exception& problem) {
    return fail("the launcher's answer is not understood: " + std::string(problem.what()));
  }
}

std::string control_file_name(const std::string& robot, int domain) {
  return system_file_stem(robot, domain) + ".sock";
}

}  // namespace coop::launcher
