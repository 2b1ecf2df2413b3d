#include "capture/schema/message_text.hpp"

#include <algorithm>

#include "capture/schema/cdr_walk.hpp"
#include "capture/schema/number_text.hpp"

namespace coop::capture {
namespace {

/// Both writers walk over elements they do not write: `hidden` counts the levels of such.
class Cut {
 public:
  explicit Cut(std::size_t max_elements) : max_elements_(max_elements) {}

  [[nodiscard]] bool is_hidden() const { return hidden_ > 0; }
  [[nodiscard]] bool is_cut(std::size_t count) const { return count > max_elements_; }
  [[nodiscard]] std::size_t shown(std::size_t count) const {
    return std::min(count, max_elements_);
  }
  [[nodiscard]] bool hides(std::size_t index) const {
    return hidden_ > 0 || (index != kNoIndex && index >= max_elements_);
  }
  void enter(std::size_t index) { hidden_ += hides(index) ? 1 : 0; }
  void leave() { hidden_ -= hidden_ > 0 ? 1 : 0; }

 private:
  std::size_t max_elements_;
  std::size_t hidden_ = 0;
};

class JsonWriter {
 public:
  JsonWriter(std::string& out, const TextOptions& options)
      : out_(out), cut_(options.max_elements) {}

  void begin_message(const FieldLayout& field, std::size_t index) {
    if (!cut_.hides(index)) {
      begin(field, index);
      out_ += '{';
    }
    cut_.enter(index);
  }
  void end_message(const FieldLayout& /*field*/) {
    if (!cut_.is_hidden()) out_ += '}';
    cut_.leave();
  }
  void begin_array(const FieldLayout& field, std::size_t count) {
    if (cut_.is_hidden()) return;
    begin(field, kNoIndex);
    out_ += '[';
    counts_.push_back(count);
  }
  void end_array(const FieldLayout& /*field*/) {
    if (cut_.is_hidden()) return;
    end_list(counts_.back());
    counts_.pop_back();
  }
  void text(const FieldLayout& field, std::size_t index, std::string_view value) {
    if (cut_.hides(index)) return;
    begin(field, index);
    append_json_string(out_, value);
  }
  void number(const FieldLayout& field, const Number& value) {
    if (cut_.is_hidden()) return;
    begin(field, kNoIndex);
    append_number(out_, value, TextStyle::kJson);
  }
  void numbers(const FieldLayout& field, const NumberArray& values) {
    if (cut_.is_hidden()) return;
    begin(field, kNoIndex);
    out_ += '[';
    const std::size_t shown = cut_.shown(values.size());
    for (std::size_t i = 0; i < shown; ++i) {
      if (i > 0) out_ += ',';
      append_number(out_, values[i], TextStyle::kJson);
    }
    end_list(values.size());
  }

 private:
  void begin(const FieldLayout& field, std::size_t index) {
    if (out_.back() != '{' && out_.back() != '[') out_ += ',';
    if (index != kNoIndex) return;
    out_ += '"';
    out_ += field.name;
    out_ += "\":";
  }
  void end_list(std::size_t count) {
    if (cut_.is_cut(count)) out_ += out_.back() == '[' ? "\"...\"" : ",\"...\"";
    out_ += ']';
  }

  std::string& out_;
  Cut cut_;
  std::vector<std::size_t> counts_;
};

class YamlWriter {
 public:
  YamlWriter(std::string& out, const TextOptions& options)
      : out_(out), cut_(options.max_elements), level_(options.indent) {}

  void begin_message(const FieldLayout& field, std::size_t index) {
    if (!cut_.hides(index)) {
      if (index == kNoIndex) {
        name(field);
        out_ += '\n';
      } else {
        indent();
        out_ += "- ";
        after_dash_ = true;
      }
      ++level_;
    }
    cut_.enter(index);
  }
  void end_message(const FieldLayout& /*field*/) {
    if (!cut_.is_hidden()) {
      --level_;
      if (after_dash_) out_ += "{}\n";
      after_dash_ = false;
    }
    cut_.leave();
  }
  void begin_array(const FieldLayout& field, std::size_t count) {
    if (cut_.is_hidden()) return;
    name(field);
    out_ += count == 0 ? " []\n" : "\n";
    counts_.push_back(count);
  }
  void end_array(const FieldLayout& /*field*/) {
    if (cut_.is_hidden()) return;
    end_list(counts_.back());
    counts_.pop_back();
  }
  void text(const FieldLayout& field, std::size_t index, std::string_view value) {
    if (cut_.hides(index)) return;
    if (index == kNoIndex) {
      name(field);
      out_ += ' ';
    } else {
      indent();
      out_ += "- ";
    }
    append_yaml_string(out_, value);
    out_ += '\n';
  }
  void number(const FieldLayout& field, const Number& value) {
    if (cut_.is_hidden()) return;
    name(field);
    out_ += ' ';
    append_number(out_, value, TextStyle::kYaml);
    out_ += '\n';
  }
  void numbers(const FieldLayout& field, const NumberArray& values) {
    if (cut_.is_hidden()) return;
    name(field);
    out_ += values.size() == 0 ? " []\n" : "\n";
    const std::size_t shown = cut_.shown(values.size());
    for (std::size_t i = 0; i < shown; ++i) {
      indent();
      out_ += "- ";
      append_number(out_, values[i], TextStyle::kYaml);
      out_ += '\n';
    }
    end_list(values.size());
  }

 private:
  /// The first field of an element stands behind its dash.
  void indent() {
    if (!after_dash_) out_.append(level_ * 2, ' ');
    after_dash_ = false;
  }
  void name(const FieldLayout& field) {
    indent();
    out_ += field.name;
    out_ += ':';
  }
  void end_list(std::size_t count) {
    if (!cut_.is_cut(count)) return;
    indent();
    out_ += "- '...'\n";
  }

  std::string& out_;
  Cut cut_;
  std::vector<std::size_t> counts_;
  std::size_t level_;
  bool after_dash_ = false;
};

}  // namespace

Result<void, CdrError> append_yaml(const MessageLayout& layout, std::span<const std::byte> payload,
                                   const TextOptions& options, std::string& out) {
  const auto read = walk(layout, payload, YamlWriter(out, options));
  if (!read) return fail(read.error());
  return {};
}

Result<void, CdrError> append_json(const MessageLayout& layout, std::span<const std::byte> payload,
                                   const TextOptions& options, std::string& out) {
  const std::size_t before = out.size();
  out += '{';
  const auto read = walk(layout, payload, JsonWriter(out, options));
  if (!read) {
    out.resize(before);
    return fail(read.error());
  }
  out += '}';
  return {};
}

}  // namespace coop::capture
