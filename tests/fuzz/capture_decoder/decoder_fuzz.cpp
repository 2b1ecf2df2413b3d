// libFuzzer target: definitions and payloads made up by somebody who wishes us ill. An input is the
// number of a known type and a payload, or (first byte 255) definition text, a zero byte and a
// payload.
#include <cstdint>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "capture/schema/csv_columns.hpp"
#include "capture/schema/definitions_table.hpp"
#include "capture/schema/message_text.hpp"
#include "capture/schema/payload_difference.hpp"

namespace coop::capture {
namespace {

constexpr std::uint8_t kOwnDefinition = 255;

void require(bool condition) {
  if (!condition) std::abort();
}

void decode(const MessageLayout& layout, std::span<const std::byte> payload) {
  std::string json;
  const bool decoded = append_json(layout, payload, {}, json).has_value();
  require(decoded ? nlohmann::json::accept(json) : json.empty());
  std::string yaml;
  require(append_yaml(layout, payload, {.max_elements = 3}, yaml).has_value() == decoded);

  CsvColumns columns(layout, {.max_elements = 100});
  require(columns.measure(payload).has_value() == decoded);
  if (decoded) {
    columns.settle();
    const auto row = columns.row(payload);
    require(row.has_value() && (*row)->size() == columns.names().size());
  }

  // A message is the same as itself, whatever is behind it; and cut short it is another or none.
  std::vector<std::byte> longer(payload.begin(), payload.end());
  longer.push_back(std::byte{1});
  const auto same = first_difference(layout, payload, longer);
  require(same.has_value() == decoded && (!decoded || !*same));
  (void)first_difference(layout, longer, payload.first(payload.size() / 2));
}

}  // namespace
}  // namespace coop::capture

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace coop::capture;
  if (size < 1) return 0;
  std::span<const std::byte> payload = std::as_bytes(std::span(data, size)).subspan(1);
  try {
    if (data[0] != kOwnDefinition) {
      const auto table = definitions_table();
      const KnownDefinition& known = table[data[0] % table.size()];
      decode(MessageLayout(known.name, known.text), payload);
      return 0;
    }
    const std::string_view text(reinterpret_cast<const char*>(payload.data()), payload.size());
    const auto end = std::min(text.find('\0'), text.size());
    const MessageLayout layout("p/M", text.substr(0, end));
    decode(layout, payload.subspan(std::min(end + 1, payload.size())));
  } catch (const DefinitionError&) {
    // What is refused with its reason is as it should be.
  }
  return 0;
}
