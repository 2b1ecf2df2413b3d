#include "architecture/function_length.hpp"

#include <regex>

namespace coop::architecture {
namespace {

/// The text with comments, strings and preprocessor lines blanked, line breaks kept.
class Blanker {
 public:
  explicit Blanker(std::string_view text) : text_(text) {}

  std::string run() {
    while (at_ < text_.size()) {
      if (starts("//") || (text_[at_] == '#' && at_line_start_)) {
        skip_line();
      } else if (starts("/*")) {
        skip_past("*/");
      } else if (starts("R\"")) {
        skip_raw_string();
      } else if (text_[at_] == '"' || (text_[at_] == '\'' && !in_number())) {
        skip_quoted(text_[at_]);
      } else {
        at_line_start_ = text_[at_] == '\n' || (at_line_start_ && std::isspace(text_[at_]) != 0);
        out_ += text_[at_++];
      }
    }
    return std::move(out_);
  }

 private:
  [[nodiscard]] bool starts(std::string_view what) const {
    return text_.substr(at_, what.size()) == what;
  }
  /// 1'000 is no character.
  [[nodiscard]] bool in_number() const {
    return at_ > 0 && std::isxdigit(static_cast<unsigned char>(text_[at_ - 1])) != 0;
  }
  void blank_until(std::size_t end) {
    for (; at_ < std::min(end, text_.size()); ++at_) {
      if (text_[at_] == '\n') out_ += '\n';
    }
  }
  void skip_line() {
    std::size_t end = text_.find('\n', at_);
    while (end != std::string_view::npos && end > 0 && text_[end - 1] == '\\') {
      end = text_.find('\n', end + 1);
    }
    blank_until(end);
  }
  void skip_past(std::string_view mark) {
    const std::size_t end = text_.find(mark, at_ + 2);
    blank_until(end == std::string_view::npos ? end : end + mark.size());
  }
  void skip_raw_string() {
    const std::size_t open = text_.find('(', at_);
    const std::string close = ")" + std::string(text_.substr(at_ + 2, open - at_ - 2)) + "\"";
    skip_past(close);
    out_ += '0';
  }
  void skip_quoted(char quote) {
    std::size_t end = at_ + 1;
    while (end < text_.size() && text_[end] != quote) end += text_[end] == '\\' ? 2 : 1;
    blank_until(end + 1);
    out_ += '0';
  }

  std::string_view text_;
  std::string out_;
  std::size_t at_ = 0;
  bool at_line_start_ = true;
};

bool is_function_head(const std::string& head) {
  static const std::regex kScope(
      R"(^\s*(template\s*<.*>\s*)?(inline\s+)?(namespace|class|struct|union|enum|extern)\b)");
  if (head.find('(') == std::string::npos) return false;
  // A struct as return type is a function all the same: its parameter list tells.
  return !std::regex_search(head, kScope) ||
         std::regex_search(head, std::regex(R"(\)\s*(const|noexcept|override)*\s*$)"));
}

std::string in_one_line(const std::string& head) {
  const std::string text = std::regex_replace(head, std::regex(R"(\s+)"), " ");
  return text.starts_with(' ') ? text.substr(1) : text;
}

}  // namespace

std::vector<Function> find_functions(std::string_view text) {
  const std::string code = Blanker(text).run();
  std::vector<Function> functions;
  std::string head;
  std::size_t line = 1;
  std::size_t depth = 0;
  std::size_t function_depth = 0;  // 0: not within a function
  Function current;
  for (const char c : code) {
    if (c == '\n') ++line;
    if (c == '{') {
      ++depth;
      if (function_depth == 0 && is_function_head(head)) {
        function_depth = depth;
        current = {in_one_line(head), line, 0};
      }
      head.clear();
    } else if (c == '}') {
      if (function_depth != 0 && depth == function_depth) {
        current.length = line - current.line + 1;
        functions.push_back(current);
        function_depth = 0;
      }
      if (depth > 0) --depth;
      head.clear();
    } else if (c == ';') {
      head.clear();
    } else {
      head += c;
    }
  }
  return functions;
}

}  // namespace coop::architecture
