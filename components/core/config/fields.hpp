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

/// A visitor over the fields of a configuration struct. Each struct has defaults in its member
/// initialisers and
///
///   void describe(config::Fields& fields) {
///     fields.number("max_vel_x", max_vel_x, {.unit = "m/s", .help = "fastest forward", .min = 0,
///     .max = 2}); fields.section("footprint", footprint);
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

 protected:
  virtual bool begin_section(std::string_view name) = 0;
  virtual void end_section() = 0;
  /// Sets `size` to the number of elements to visit.
  virtual bool begin_list(std::string_view name, std::size_t& size) = 0;
  virtual void begin_element(std::size_t index) = 0;
  virtual void end_list() = 0;
};

}  // namespace coop::config
