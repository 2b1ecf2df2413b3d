#include "conversions/image.hpp"

#include <array>
#include <cstring>
#include <string_view>

#include "conversions/time.hpp"

namespace coop::conversions {
namespace {

struct Encoding {
  std::string_view name;
  int type;
};
constexpr std::array<Encoding, 5> kEncodings{{{"rgb8", CV_8UC3},
                                              {"bgr8", CV_8UC3},
                                              {"mono8", CV_8UC1},
                                              {"16UC1", CV_16UC1},
                                              {"32FC1", CV_32FC1}}};

Result<int> type_of(const std::string& encoding) {
  for (const Encoding& known : kEncodings) {
    if (known.name == encoding) return known.type;
  }
  return fail("unknown encoding of pixels \"" + encoding + "\"");
}

bool is_reasonable(std::uint32_t edge) {
  return edge > 0 && edge <= kMaxImageEdge;
}

}  // namespace

Result<sensor_msgs::msg::Image> to_msg(const Picture& picture) {
  const auto type = type_of(picture.encoding);
  if (!type) return fail(type.error());
  const cv::Mat& pixels = picture.pixels;
  if (pixels.empty() || pixels.dims != 2) return fail("an empty picture");
  if (pixels.type() != *type) return fail("pixels are not what " + picture.encoding + " says");
  const std::size_t step = pixels.elemSize() * static_cast<std::size_t>(pixels.cols);

  sensor_msgs::msg::Image message;
  message.header(to_header(picture.stamp, picture.frame_id));
  message.height(static_cast<std::uint32_t>(pixels.rows));
  message.width(static_cast<std::uint32_t>(pixels.cols));
  message.encoding(picture.encoding);
  message.is_bigendian(0);
  message.step(static_cast<std::uint32_t>(step));
  message.data().resize(step * static_cast<std::size_t>(pixels.rows));
  for (int row = 0; row < pixels.rows; ++row) {
    std::memcpy(message.data().data() + step * static_cast<std::size_t>(row), pixels.ptr(row),
                step);
  }
  return message;
}

Result<Picture> from_msg(const sensor_msgs::msg::Image& message) {
  const auto stamp = from_msg(message.header().stamp());
  if (!stamp) return fail(stamp.error());
  const auto type = type_of(message.encoding());
  if (!type) return fail(type.error());
  if (!is_reasonable(message.width()) || !is_reasonable(message.height())) {
    return fail("a picture of absurd size");
  }
  const std::size_t row_size = CV_ELEM_SIZE(*type) * std::size_t{message.width()};
  if (message.step() < row_size) return fail("rows shorter than their pixels");
  if (message.data().size() != std::size_t{message.step()} * message.height()) {
    return fail("not as many bytes as rows times step");
  }
  if (message.is_bigendian() != 0 && CV_MAT_DEPTH(*type) != CV_8U) {
    return fail("pixels in big endian order");
  }
  Picture picture{*stamp, message.header().frame_id(), message.encoding(), {}};
  picture.pixels.create(static_cast<int>(message.height()), static_cast<int>(message.width()),
                        *type);
  for (int row = 0; row < picture.pixels.rows; ++row) {
    std::memcpy(picture.pixels.ptr(row),
                message.data().data() + message.step() * static_cast<std::size_t>(row), row_size);
  }
  return picture;
}

}  // namespace coop::conversions
