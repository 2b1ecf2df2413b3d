#include <cmath>
#include <sstream>

#include "core/config/config.hpp"

namespace coop::config {
namespace {

std::string precise(double value) {
  std::ostringstream out;
  out.precision(15);
  out << value;
  return out.str();
}

std::string in_quotes(const std::string& value) {
  std::string out = "\"";
  for (const char c : value) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + "\"";
}

template <class T, class Show>
std::string joined(const std::vector<T>& values, Show show) {
  std::string out = "[";
  for (std::size_t i = 0; i < values.size(); ++i) out += (i == 0 ? "" : ", ") + show(values[i]);
  return out + "]";
}

/// Turns every kind of field into text; what is done with it differs.
class TextFields : public Fields {
 public:
  using Fields::integer;
  void number(std::string_view name, double& value, const Spec& spec) override {
    emit(name, precise(value), spec);
  }
  void integer(std::string_view name, std::int64_t& value, const Spec& spec) override {
    emit(name, std::to_string(value), spec);
  }
  void flag(std::string_view name, bool& value, const Spec& spec) override {
    emit(name, value ? "true" : "false", spec);
  }
  void text(std::string_view name, std::string& value, const Spec& spec) override {
    emit(name, in_quotes(value), spec);
  }
  void choice(std::string_view name, std::string& value, std::span<const std::string_view> choices,
              const Spec& spec) override {
    choices_ = choices;
    emit(name, value, spec);
    choices_ = {};
  }
  void numbers(std::string_view name, std::vector<double>& value, const Spec& spec) override {
    emit(name, joined(value, [](double item) { return precise(item); }), spec);
  }
  void texts(std::string_view name, std::vector<std::string>& value, const Spec& spec) override {
    emit(name, joined(value, in_quotes), spec);
  }
  [[nodiscard]] std::string where(std::string_view) const override { return ""; }

 protected:
  virtual void emit(std::string_view name, const std::string& value, const Spec& spec) = 0;
  std::span<const std::string_view> choices_;
};

class YamlWriter : public TextFields {
 public:
  explicit YamlWriter(std::string& out) : out_(out) {}

  void assignments(std::string_view name, std::vector<Assignment>& value, const Spec&) override {
    if (value.empty()) return;
    begin_section(name);
    for (const Assignment& item : value) {
      start_line();
      out_ += item.key + ": " + item.value + "\n";
    }
    end_section();
  }

 protected:
  void emit(std::string_view name, const std::string& value, const Spec&) override {
    start_line();
    out_ += std::string(name) + ": " + value + "\n";
  }
  bool begin_section(std::string_view name) override {
    start_line();
    out_ += std::string(name) + ":\n";
    depth_ += 1;
    return true;
  }
  void end_section() override { depth_ -= 1; }
  bool begin_list(std::string_view name, std::size_t& size) override {
    start_line();
    out_ += std::string(name) + (size == 0 ? ": []\n" : ":\n");
    return true;
  }
  void begin_element(std::size_t) override {
    depth_ += 1;
    dash_ = true;
  }
  void end_list() override {}
  bool begin_mapping(std::string_view name, std::vector<std::string>& names) override {
    if (names.empty()) return false;
    return begin_section(name);
  }

 private:
  void start_line() {
    const std::size_t indent = 2 * depth_;
    out_ += dash_ ? std::string(indent - 2, ' ') + "- " : std::string(indent, ' ');
    dash_ = false;
  }

  std::string& out_;
  std::size_t depth_ = 0;
  bool dash_ = false;
};

class TableWriter : public TextFields {
 public:
  explicit TableWriter(std::string& out) : out_(out) {}

  void assignments(std::string_view name, std::vector<Assignment>&, const Spec& spec) override {
    emit(std::string(name) + ".*", "", spec);
  }

 protected:
  void emit(std::string_view name, const std::string& value, const Spec& spec) override {
    out_ += "| " + prefix_ + std::string(name) + " | " + value + " | " + std::string(spec.unit) +
            " | " + bounds(spec) + " | " + std::string(spec.help) + " |\n";
  }
  bool begin_section(std::string_view name) override {
    lengths_.push_back(prefix_.size());
    prefix_ += std::string(name) + ".";
    return true;
  }
  void end_section() override {
    prefix_.resize(lengths_.back());
    lengths_.pop_back();
  }
  bool begin_list(std::string_view name, std::size_t& size) override {
    // One element's fields stand for all of them.
    size = 1;
    return begin_section(std::string(name) + "[]");
  }
  void begin_element(std::size_t) override { lengths_.push_back(prefix_.size()); }
  void end_list() override { end_section(); }
  bool begin_mapping(std::string_view name, std::vector<std::string>& names) override {
    // One element's fields stand for all of them.
    names = {"NAME"};
    return begin_section(name);
  }

 private:
  [[nodiscard]] std::string bounds(const Spec& spec) const {
    std::string out;
    for (const std::string_view choice : choices_) {
      out += (out.empty() ? "" : ", ") + std::string(choice);
    }
    if (!choices_.empty()) return out;
    const bool low = std::isfinite(spec.min);
    const bool high = std::isfinite(spec.max);
    if (low && high) return precise(spec.min) + " .. " + precise(spec.max);
    if (low) return ">= " + precise(spec.min);
    return high ? "<= " + precise(spec.max) : "";
  }

  std::string& out_;
  std::string prefix_;
  std::vector<std::size_t> lengths_;
};

}  // namespace

std::unique_ptr<Fields> make_yaml_writer(std::string& out) {
  return std::make_unique<YamlWriter>(out);
}

std::unique_ptr<Fields> make_table_writer(std::string& out) {
  return std::make_unique<TableWriter>(out);
}

}  // namespace coop::config
