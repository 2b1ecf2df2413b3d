#include "core/image/picture_file.hpp"

#include <png.h>
#include <turbojpeg.h>

#include <cstdint>
#include <memory>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <system_error>

#include "core/atomic_file.hpp"

namespace coop {
namespace {

constexpr std::int64_t kMostPixels = 64'000'000;
constexpr std::string_view kPngBegin{"\x89PNG", 4};
constexpr std::string_view kJpegBegin{"\xFF\xD8\xFF", 3};

bool is_reasonable(std::int64_t width, std::int64_t height) {
  return width > 0 && height > 0 && width <= kMostPixels / height;
}

/// Frees what libpng holds, also after an error.
struct PngImage : png_image {
  PngImage() : png_image{} { version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(this); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
};

Result<cv::Mat> decode_png(const std::string& bytes) {
  PngImage image;
  if (png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()) == 0) {
    return fail(std::string(image.message));
  }
  if (!is_reasonable(image.width, image.height)) return fail("too many pixels");
  image.format = PNG_FORMAT_RGB;
  cv::Mat picture(static_cast<int>(image.height), static_cast<int>(image.width), CV_8UC3);
  constexpr png_color kBehind{};
  if (png_image_finish_read(&image, &kBehind, picture.data, static_cast<int>(picture.step[0]),
                            nullptr) == 0) {
    return fail(std::string(image.message));
  }
  return picture;
}

Result<cv::Mat> decode_jpeg(const std::string& bytes) {
  const std::unique_ptr<void, int (*)(tjhandle)> codec(tjInitDecompress(), tjDestroy);
  if (!codec) return fail("no JPEG decoder");
  const auto* data = reinterpret_cast<const unsigned char*>(bytes.data());
  int width = 0;
  int height = 0;
  int subsampling = 0;
  int colours = 0;
  if (tjDecompressHeader3(codec.get(), data, bytes.size(), &width, &height, &subsampling,
                          &colours) != 0) {
    return fail(std::string(tjGetErrorStr2(codec.get())));
  }
  if (!is_reasonable(width, height)) return fail("too many pixels");
  cv::Mat picture(height, width, CV_8UC3);
  // Colours at full resolution, with the exact transform: a picture is looked at for a shade.
  if (tjDecompress2(codec.get(), data, bytes.size(), picture.data, width,
                    static_cast<int>(picture.step[0]), height, TJPF_RGB,
                    TJFLAG_ACCURATEDCT | TJFLAG_STOPONWARNING) != 0) {
    return fail(std::string(tjGetErrorStr2(codec.get())));
  }
  return picture;
}

}  // namespace

Result<cv::Mat> read_picture(const std::filesystem::path& path) {
  std::string bytes;
  try {
    bytes = read_file(path);
  } catch (const std::system_error& problem) {
    return fail(std::string(problem.what()));
  }
  if (bytes.starts_with(kPngBegin)) return decode_png(bytes);
  if (bytes.starts_with(kJpegBegin)) return decode_jpeg(bytes);
  return fail("neither PNG nor JPEG");
}

std::string encode_png(const cv::Mat& picture) {
  if (picture.empty() || picture.type() != CV_8UC3) {
    throw std::invalid_argument("expected a picture of three colours of 8 bits");
  }
  PngImage image;
  image.width = static_cast<png_uint_32>(picture.cols);
  image.height = static_cast<png_uint_32>(picture.rows);
  image.format = PNG_FORMAT_BGR;
  image.flags = PNG_IMAGE_FLAG_FAST;
  const int step = static_cast<int>(picture.step[0]);
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, picture.data, step, nullptr) == 0) {
    throw std::runtime_error(std::string("PNG: ") + image.message);
  }
  bytes.resize(size);
  return bytes;
}

}  // namespace coop
