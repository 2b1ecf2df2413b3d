#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/pose.hpp"
#include "core/time.hpp"

namespace coop::carmen {

/// Walks over the fields of one line, parted by blanks. What is missing or of the wrong type throws
/// FormatError that says what was expected; the caller adds file and line.
class FieldCursor {
 public:
  explicit FieldCursor(std::string_view line) : rest_(line) {}

  std::string_view word(std::string_view what);
  double number(std::string_view what);  ///< finite
  Pose2 pose(std::string_view what);
  /// Seconds: a plain decimal is exact to the nanosecond.
  Time stamp(std::string_view what);
  /// A count and as many numbers; infinities and NaN are allowed.
  std::vector<float> values(std::string_view what);

 private:
  std::string_view rest_;
};

/// Calls `read` with the fields of each line that is neither empty nor a comment (#). Its
/// FormatError comes out as std::runtime_error `name:line: ...`.
void for_each_line(std::string_view text, const std::string& name,
                   const std::function<void(FieldCursor&)>& read);

/// The number that the whole text is, or nothing.
[[nodiscard]] std::optional<double> parse_number(std::string_view text);

}  // namespace coop::carmen
