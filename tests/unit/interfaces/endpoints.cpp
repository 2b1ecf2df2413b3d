#include "unit/interfaces/endpoints.hpp"

#include <fstream>
#include <iterator>
#include <map>
#include <regex>

namespace coop::test {
namespace {

const std::regex kAlias(R"(using\s+(\w+)\s*=\s*([\w:]+)\s*;)");
const std::regex kUsing(R"(using\s+(\w+::msg::(\w+))\s*;)");
const std::regex kCall(R"((advertise|subscribe)\s*<)");
const std::regex kEndpoint(
    R"re((advertise|subscribe)\s*<\s*([\w:]+)\s*>\s*\(\s*"([\w/]+)"\s*,\s*(?:\w+::)*Qos::(k\w+))re");
const std::regex kComment(R"(//[^\n]*)");

std::string message_name(const std::string& written) {
  static const std::regex kMessage(R"((?:::)?(\w+)::msg::(\w+))");
  std::smatch match;
  if (!std::regex_match(written, match, kMessage)) return written;
  return match[1].str() + "/" + match[2].str();
}

}  // namespace

SourceEndpoints find_endpoints(const std::string& commented) {
  const std::string text = std::regex_replace(commented, kComment, "");
  std::map<std::string, std::string> aliases;
  for (std::sregex_iterator it(text.begin(), text.end(), kAlias), end; it != end; ++it) {
    aliases[(*it)[1]] = (*it)[2];
  }
  for (std::sregex_iterator it(text.begin(), text.end(), kUsing), end; it != end; ++it) {
    aliases[(*it)[2]] = (*it)[1];
  }
  SourceEndpoints result;
  for (std::sregex_iterator it(text.begin(), text.end(), kEndpoint), end; it != end; ++it) {
    const std::string written = (*it)[2];
    const auto alias = aliases.find(written);
    result.endpoints.push_back(
        {.topic = (*it)[3],
         .type = message_name(alias == aliases.end() ? written : alias->second),
         .qos = (*it)[4],
         .writes = (*it)[1] == "advertise"});
  }
  const auto calls =
      std::distance(std::sregex_iterator(text.begin(), text.end(), kCall), std::sregex_iterator());
  result.unreadable = static_cast<int>(calls) - static_cast<int>(result.endpoints.size());

  const auto add_if = [&](const std::string& call, Endpoint endpoint) {
    if (std::regex_search(text, std::regex("\\b" + call + R"(\s*\()"))) {
      result.endpoints.push_back(std::move(endpoint));
    }
  };
  const std::string type = "tf2_msgs/TFMessage";
  add_if("publish_transform", {"tf", type, "kEvent", true});
  add_if("publish_static_transform", {"tf_static", type, "kStateLatched", true});
  add_if(R"(transforms)", {"tf", type, "kEvent", false});
  return result;
}

std::string source_text(const std::filesystem::path& folder) {
  std::string text;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const auto extension = entry.path().extension();
    if (extension != ".cpp" && extension != ".hpp") continue;
    std::ifstream file(entry.path());
    text.append(std::istreambuf_iterator<char>(file), {});
    text += '\n';
  }
  return text;
}

}  // namespace coop::test
