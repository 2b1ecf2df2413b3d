#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace coop::map {

/// A map that cannot be read or that this robot cannot use; one line that names the file.
class MapError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Grey image, row 0 on top as in the file, 0 black to max_value white. 16 bit samples are kept.
struct GreyImage {
  int width = 0;
  int height = 0;
  int max_value = 255;
  std::vector<std::uint16_t> pixels;
};

/// Reads PGM (P2 text or P5 binary, comments, up to 16 bit). Throws MapError; `name` stands for the
/// file in messages.
[[nodiscard]] GreyImage parse_pgm(std::string_view content, const std::string& name);
/// Binary PGM, 8 bit.
[[nodiscard]] std::string to_pgm(const GreyImage& image, std::string_view comment);

}  // namespace coop::map
