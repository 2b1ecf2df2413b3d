#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "core/result.hpp"
#include "launcher/system_view.hpp"

namespace coop::launcher {

/// The launcher's control protocol: over a Unix socket, one JSON object a line, one answer for each
/// request.
///
///   {"verb": "restart", "name": "dwa"}   ->  {"ok": true}
///   {"verb": "ps"}                       ->  {"ok": true, "system": {...}}
///   {"verb": "stop", "name": "dwaa"}     ->  {"ok": false, "error": "no component 'dwaa'; did you
///   mean 'dwa'?"}
///
/// Verbs: ps, restart, stop, start (with a name), down.
struct ControlRequest {
  std::string verb;
  std::string name;
};

struct ControlReply {
  bool ok = true;
  std::string error;
  SystemView system;  ///< for ps
};

/// Without the newline. A line that is no request is an error in one line.
[[nodiscard]] std::string encode(const ControlRequest& request);
[[nodiscard]] std::string encode(const ControlReply& reply);
[[nodiscard]] Result<ControlRequest> decode_request(std::string_view line);
[[nodiscard]] Result<ControlReply> decode_reply(std::string_view line);

/// In a runtime folder (core/runtime_folder.hpp): DOMAIN.sock or DOMAIN-ROBOT.sock
[[nodiscard]] std::string control_file_name(const std::string& robot, int domain);

}  // namespace coop::launcher
