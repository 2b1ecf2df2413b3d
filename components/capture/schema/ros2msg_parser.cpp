#include <charconv>
#include <limits>

#include "capture/schema/message_definition.hpp"

namespace coop::capture {
namespace {

using Array = FieldDefinition::Array;

constexpr std::string_view kSpace = " \t\r";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(kSpace);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(kSpace) - first + 1);
}

/// Where a comment begins: a # outside of quotes.
std::size_t comment_start(std::string_view line) {
  char quote = 0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (quote != 0) {
      if (c == '\\') {
        ++i;
      } else if (c == quote) {
        quote = 0;
      }
    } else if (c == '#') {
      return i;
    } else if (c == '"' || (c == '\'' && i > 0 && kSpace.find(line[i - 1]) != kSpace.npos)) {
      quote = c;
    }
  }
  // A quote left open is none (an apostrophe): the first # then counts.
  return quote != 0 ? line.find('#') : std::string_view::npos;
}

class LineParser {
 public:
  LineParser(std::string_view package, std::string_view line, std::size_t number)
      : package_(package), whole_(trimmed(line)), number_(number) {
    const auto comment = comment_start(line);
    if (comment != std::string_view::npos) {
      comment_ = trimmed(line.substr(comment + 1));
      line = line.substr(0, comment);
    }
    content_ = trimmed(line);
  }

  [[nodiscard]] bool is_empty() const { return content_.empty(); }
  [[nodiscard]] std::string_view comment() const { return comment_; }

  void parse_into(MessageDefinition& message) {
    FieldDefinition field = parse_type(take_type());
    const auto end = content_.find_first_of(" \t=");
    field.name = content_.substr(0, end);
    if (!is_name(field.name)) refuse("no name");
    const std::string_view rest =
        end == std::string_view::npos ? std::string_view() : trimmed(content_.substr(end));
    field.comment = comment_;
    if (rest.starts_with('=')) {
      message.constants.push_back(constant(field, trimmed(rest.substr(1))));
      return;
    }
    field.default_value = rest;
    for (const FieldDefinition& other : message.fields) {
      if (other.name == field.name) refuse("the name is used twice");
    }
    message.fields.push_back(std::move(field));
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw DefinitionError("line " + std::to_string(number_) + ": " + why + ": '" +
                          std::string(whole_.substr(0, 120)) + "'");
  }

  static bool is_name(std::string_view name) {
    if (name.empty() || (name[0] >= '0' && name[0] <= '9')) return false;
    return name.find_first_not_of(
               "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_") == name.npos;
  }

  std::string_view take_type() {
    const auto end = content_.find_first_of(kSpace);
    if (end == std::string_view::npos) refuse("a type without a name");
    const std::string_view type = content_.substr(0, end);
    content_ = trimmed(content_.substr(end));
    return type;
  }

  /// `base`, `base<=bound`, then nothing, `[]`, `[size]` or `[<=bound]`.
  FieldDefinition parse_type(std::string_view type) {
    FieldDefinition field;
    if (type.ends_with(']')) {
      const auto open = type.find('[');
      if (open == std::string_view::npos) refuse("no type");
      std::string_view size = type.substr(open + 1, type.size() - open - 2);
      const bool bound = size.starts_with("<=");
      field.array = size.empty() || bound ? Array::kSequence : Array::kFixed;
      if (bound) size.remove_prefix(2);
      if (bound || field.array == Array::kFixed) field.size = number(size);
      type = type.substr(0, open);
    }
    const auto bound = type.find("<=");
    if (bound != std::string_view::npos) {
      field.string_bound = number(type.substr(bound + 2));
      type = type.substr(0, bound);
      if (type != "string" && type != "wstring") refuse("only strings have a bound");
    }
    field.type = resolved(type);
    return field;
  }

  std::string resolved(std::string_view type) {
    if (is_primitive_type(type)) return std::string(type);
    if (type == "wstring" || type == "wchar" || type == "float128") {
      refuse("type " + std::string(type) + " has no one encoding");
    }
    try {
      if (type.find('/') != std::string_view::npos) return short_type_name(type);
      return short_type_name(std::string(package_) + "/" + std::string(type));
    } catch (const DefinitionError&) {
      refuse("no type");
    }
  }

  std::uint32_t number(std::string_view text) {
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size() || value == 0) {
      refuse("no size above zero");
    }
    return value;
  }

  ConstantDefinition constant(const FieldDefinition& field, std::string_view value) {
    if (!is_primitive_type(field.type) || field.array != Array::kNone) {
      refuse("a constant of a type that has none");
    }
    if (value.empty()) refuse("a constant without a value");
    return {field.type, field.name, std::string(value), std::string(comment_)};
  }

  std::string_view package_;
  std::string_view whole_;
  std::size_t number_;
  std::string_view content_;
  std::string_view comment_;
};

bool is_separator(std::string_view line) {
  return line.size() >= 3 && line.find_first_not_of('=') == std::string_view::npos;
}

/// Calls take(line) for each line without its end.
template <class Take>
void for_each_line(std::string_view text, const Take& take) {
  while (!text.empty()) {
    const auto end = text.find('\n');
    take(text.substr(0, end));
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
}

class TextParser {
 public:
  explicit TextParser(std::string_view name) { begin(name); }

  void take(std::string_view line) {
    ++number_;
    const std::string_view content = trimmed(line);
    if (is_separator(content)) {
      awaits_name_ = true;
      return;
    }
    if (awaits_name_) return take_name(content);
    LineParser parser(package_, line, number_);
    if (!parser.is_empty()) {
      parser.parse_into(definitions_.back());
    } else if (!parser.comment().empty() && definitions_.back().fields.empty() &&
               definitions_.back().constants.empty()) {
      definitions_.back().comments.emplace_back(parser.comment());
    }
  }

  std::vector<MessageDefinition> finish() {
    if (awaits_name_) throw DefinitionError("the text ends where `MSG: package/Type` is expected");
    return std::move(definitions_);
  }

 private:
  void begin(std::string_view name) {
    definitions_.emplace_back().name = short_type_name(name);
    package_ = definitions_.back().name.substr(0, definitions_.back().name.find('/'));
  }

  void take_name(std::string_view content) {
    if (content.empty()) return;
    if (!content.starts_with("MSG:")) {
      throw DefinitionError("line " + std::to_string(number_) + ": expected `MSG: package/Type`");
    }
    begin(trimmed(content.substr(4)));
    awaits_name_ = false;
  }

  std::vector<MessageDefinition> definitions_;
  std::string package_;
  std::size_t number_ = 0;
  bool awaits_name_ = false;
};

}  // namespace

MessageDefinition parse_message_definition(std::string_view name, std::string_view text) {
  auto definitions = parse_ros2msg(name, text);
  if (definitions.size() > 1) throw DefinitionError("more than one definition");
  return std::move(definitions.front());
}

std::vector<MessageDefinition> parse_ros2msg(std::string_view name, std::string_view text) {
  TextParser parser(name);
  for_each_line(text, [&](std::string_view line) { parser.take(line); });
  return parser.finish();
}

}  // namespace coop::capture
