#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace coop::capture {

/// A definition that cannot be read; the message names the line and what was expected.
class DefinitionError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One field, in the words of ROS 2's message language: `string<=10[<=5] name default  # comment`.
struct FieldDefinition {
  enum class Array : std::uint8_t { kNone, kFixed, kSequence };

  std::string type;                ///< bool .. float64, string, byte, char, or "package/Type"
  std::uint32_t string_bound = 0;  ///< most characters of a string; 0: no bound
  Array array = Array::kNone;
  std::uint32_t size = 0;  ///< elements of a fixed array; most of a sequence, 0: no bound
  std::string name;
  std::string default_value{};  ///< as written, empty for none
  std::string comment{};
  bool key = false;  ///< IDL only

  /// "string<=10[<=5]"
  [[nodiscard]] std::string full_type() const;
};

struct ConstantDefinition {
  std::string type;
  std::string name;
  std::string value;
  std::string comment{};
};

struct MessageDefinition {
  std::string name{};                   ///< "package/Type"
  std::vector<std::string> comments{};  ///< lines above the definition
  std::vector<ConstantDefinition> constants{};
  std::vector<FieldDefinition> fields{};
  bool is_final = false;  ///< IDL only
};

[[nodiscard]] bool is_primitive_type(std::string_view type);

/// "package/Type" of "package/msg/Type" or of itself; throws DefinitionError for anything else.
[[nodiscard]] std::string short_type_name(std::string_view name);
/// "package/msg/Type" of either form.
[[nodiscard]] std::string long_type_name(std::string_view name);

/// One definition without those it depends on. Types without package are of the package of `name`.
/// Defaults and constants are kept as written. Throws DefinitionError.
[[nodiscard]] MessageDefinition parse_message_definition(std::string_view name,
                                                         std::string_view text);

/// A definition with all it depends on, as MCAP and rosbag2 carry it: the definition itself, then
/// each other behind a line of equal signs and a line `MSG: package/Type`. The first has the name
/// given. Throws DefinitionError.
[[nodiscard]] std::vector<MessageDefinition> parse_ros2msg(std::string_view name,
                                                           std::string_view text);

/// The definition in the message language.
[[nodiscard]] std::string to_text(const MessageDefinition& definition);

/// The text that parse_ros2msg() reads: the first definition, then the others.
[[nodiscard]] std::string to_ros2msg(const std::vector<const MessageDefinition*>& definitions);

}  // namespace coop::capture
