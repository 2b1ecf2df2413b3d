#pragma once
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace coop::config {

/// What the reference tables and the error messages say of a field, and its bounds (both
/// inclusive).
struct Spec {
  std::string_view unit = "";
  std::string_view help = "";
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
};

/// One value of a mapping whose keys are free.
struct Assignment {
  std::string key;    ///< dotted
  std::string value;  ///< as one line of YAML
  std::string text;   ///< the same without the quotes of a text
  std::string where;  ///< `file:line` or `--set`, for messages
};

/// A struct that stands under a name of the user's choice, and the place of that name.
template <class Struct>
struct Named {
  std::string name;
  std::string where;
  Struct value;
};

/// A visitor over the fields of a configuration struct. Each struct has defaults in its member
/// initialisers and
///
///   void describe(config::Fields& fields) {
///     fields.number("max_vel_x", max_vel_x, {.unit = "m/s", .min = 0, .max = 2});
///     fields.section("footprint", footprint);
///   }
///   void validate() const;   // optional: throws config::Error for what bounds cannot say
///
/// One describe() serves reading strict YAML, --set overrides, printing the configuration in force
/// and the tables of the documentation. Algorithm libraries see this header only, never yaml-cpp.
class Fields {
 public:
  virtual ~Fields() = default;

  virtual void number(std::string_view name, double& value, const Spec& spec) = 0;
  virtual void integer(std::string_view name, std::int64_t& value, const Spec& spec) = 0;
  virtual void flag(std::string_view name, bool& value, const Spec& spec) = 0;
  virtual void text(std::string_view name, std::string& value, const Spec& spec) = 0;
  /// One of `choices`.
  virtual void choice(std::string_view name, std::string& value,
                      std::span<const std::string_view> choices, const Spec& spec) = 0;
  virtual void numbers(std::string_view name, std::vector<double>& value, const Spec& spec) = 0;
  virtual void texts(std::string_view name, std::vector<std::string>& value, const Spec& spec) = 0;
  /// A mapping with free keys, flattened (`limits: {v: 1}` is `limits.v`). Keys that `value` holds
  /// already are replaced, new ones appended.
  virtual void assignments(std::string_view name, std::vector<Assignment>& value,
                           const Spec& spec) = 0;
  /// `file:line` of a field that is read now, or empty where the input does not hold it.
  [[nodiscard]] virtual std::string where(std::string_view name) const = 0;

  void integer(std::string_view name, int& value, const Spec& spec) {
    constexpr double kLow = std::numeric_limits<int>::min();
    constexpr double kHigh = std::numeric_limits<int>::max();
    Spec narrowed = spec;
    if (narrowed.min < kLow) narrowed.min = kLow;
    if (narrowed.max > kHigh) narrowed.max = kHigh;
    std::int64_t wide = value;
    integer(name, wide, narrowed);
    value = static_cast<int>(wide);
  }

  /// A nested struct with its own describe().
  template <class Struct>
  void section(std::string_view name, Struct& value) {
    if (!begin_section(name)) return;
    value.describe(*this);
    end_section();
  }

  /// A sequence of structs, each with its own describe(). An element starts from the struct's
  /// defaults.
  template <class Struct>
  void list(std::string_view name, std::vector<Struct>& values) {
    std::size_t size = values.size();
    if (!begin_list(name, size)) return;
    values.resize(size);
    for (std::size_t i = 0; i < size; ++i) {
      begin_element(i);
      values[i].describe(*this);
      end_section();
    }
    end_list();
  }

  /// A mapping from names to structs, each with its own describe(), in the order of the file. A
  /// name that `values` holds already keeps what the file does not say; a new one starts from
  /// `prototype`.
  template <class Struct>
  void mapping(std::string_view name, std::vector<Named<Struct>>& values,
               const Struct& prototype = {}) {
    std::vector<std::string> names;
    names.reserve(values.size());
    for (const auto& element : values) names.push_back(element.name);
    if (!begin_mapping(name, names)) return;
    for (const std::string& key : names) {
      auto found = values.begin();
      while (found != values.end() && found->name != key) ++found;
      if (found == values.end()) found = values.insert(found, {key, "", prototype});
      const std::string place = where(key);
      if (!place.empty()) found->where = place;
      if (!begin_section(key)) continue;
      found->value.describe(*this);
      end_section();
    }
    end_section();
  }

 protected:
  virtual bool begin_section(std::string_view name) = 0;
  virtual void end_section() = 0;
  /// Sets `size` to the number of elements to visit.
  virtual bool begin_list(std::string_view name, std::size_t& size) = 0;
  virtual void begin_element(std::size_t index) = 0;
  virtual void end_list() = 0;
  /// Sets `names` to the names to visit.
  virtual bool begin_mapping(std::string_view name, std::vector<std::string>& names) = 0;
};

}  // namespace coop::config
