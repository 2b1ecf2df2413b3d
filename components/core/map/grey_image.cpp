#include "core/map/grey_image.hpp"

#include <charconv>
#include <limits>

namespace coop::map {
namespace {

constexpr std::size_t kMaxPixels = std::size_t{1} << 30;

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
}

/// Walks over a PGM's text parts.
class Scanner {
 public:
  Scanner(std::string_view content, const std::string& name) : rest_(content), name_(name) {}

  /// Next decimal number, after white space and comments.
  int number(const char* what, int max) {
    skip_blank();
    int value = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), value);
    if (error != std::errc{} || value < 0 || value > max) {
      reject("expected " + std::string(what) + ", a number from 0 to " + std::to_string(max));
    }
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    return value;
  }
  std::string_view take(std::size_t count) {
    const auto taken = rest_.substr(0, count);
    rest_.remove_prefix(taken.size());
    return taken;
  }
  [[nodiscard]] std::string_view rest() const { return rest_; }
  [[noreturn]] void reject(const std::string& what) const {
    throw MapError(name_ + ": not a readable PGM image: " + what);
  }

 private:
  void skip_blank() {
    while (!rest_.empty()) {
      if (rest_.front() == '#') {
        const auto end = rest_.find('\n');
        rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end);
      } else if (is_space(rest_.front())) {
        rest_.remove_prefix(1);
      } else {
        return;
      }
    }
  }

  std::string_view rest_;
  const std::string& name_;
};

void read_text_pixels(Scanner& scanner, GreyImage& image) {
  for (auto& pixel : image.pixels) {
    pixel = static_cast<std::uint16_t>(scanner.number("a pixel", image.max_value));
  }
}

void read_binary_pixels(Scanner& scanner, GreyImage& image) {
  if (scanner.take(1).empty()) scanner.reject("the file ends after the header");
  const bool wide = image.max_value > 255;
  const std::string_view raw = scanner.rest();
  const std::size_t needed = image.pixels.size() * (wide ? 2 : 1);
  if (raw.size() < needed) {
    scanner.reject("expected " + std::to_string(needed) + " bytes of pixels, found " +
                   std::to_string(raw.size()));
  }
  const auto byte = [&](std::size_t i) {
    return static_cast<unsigned>(static_cast<unsigned char>(raw[i]));
  };
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const unsigned value = wide ? (byte(2 * i) << 8 | byte(2 * i + 1)) : byte(i);
    if (value > static_cast<unsigned>(image.max_value)) scanner.reject("a pixel above the maximum");
    image.pixels[i] = static_cast<std::uint16_t>(value);
  }
}

}  // namespace

GreyImage parse_pgm(std::string_view content, const std::string& name) {
  Scanner scanner(content, name);
  const std::string_view magic = scanner.take(2);
  if (magic != "P2" && magic != "P5") scanner.reject("expected P2 or P5 at its start");
  GreyImage image;
  image.width = scanner.number("the width", std::numeric_limits<int>::max());
  image.height = scanner.number("the height", std::numeric_limits<int>::max());
  image.max_value = scanner.number("the maximum", 65535);
  if (image.width == 0 || image.height == 0 || image.max_value == 0) scanner.reject("empty image");
  const auto pixels =
      static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (pixels > kMaxPixels) scanner.reject("larger than 2^30 pixels");
  // The shortest pixel takes a byte: a header that lies must not cost memory.
  if (pixels > content.size()) scanner.reject("fewer pixels than width times height");
  image.pixels.resize(pixels);
  magic == "P2" ? read_text_pixels(scanner, image) : read_binary_pixels(scanner, image);
  return image;
}

std::string to_pgm(const GreyImage& image, std::string_view comment) {
  std::string out = "P5\n# " + std::string(comment) + "\n" + std::to_string(image.width) + " " +
                    std::to_string(image.height) + "\n255\n";
  out.reserve(out.size() + image.pixels.size());
  for (const auto pixel : image.pixels) {
    out.push_back(static_cast<char>(static_cast<unsigned>(pixel) * 255U /
                                    static_cast<unsigned>(image.max_value)));
  }
  return out;
}

}  // namespace coop::map
