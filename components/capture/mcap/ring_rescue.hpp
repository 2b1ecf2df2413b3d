#pragma once
#include "capture/mcap/recover.hpp"

namespace coop::mcap {

/// The folder of a ring (ring_folder.hpp) as one capture without an end, with its tail. Throws
/// std::system_error for a folder that is none.
[[nodiscard]] std::shared_ptr<const Source> open_ring(const std::filesystem::path& folder);

/// A ring whose process was killed. While it is held nobody else takes it.
class DeadRing {
 public:
  /// Those of this user in a folder of rings.
  [[nodiscard]] static std::vector<DeadRing> all_in(const std::filesystem::path& folder);
  ~DeadRing();
  DeadRing(DeadRing&& other) noexcept;
  DeadRing& operator=(DeadRing&&) = delete;

  [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }
  /// Where the capture belongs, if nothing is there yet.
  [[nodiscard]] const std::filesystem::path& origin() const { return origin_; }

  /// Of its files: about what the capture takes, or less.
  [[nodiscard]] std::uint64_t bytes() const;

  struct Written {
    std::uint64_t messages = 0;
    std::filesystem::path path;  ///< empty: there is none
  };
  /// Writes the capture, with what is said of it, and removes the ring: also where it holds no
  /// message, or its place is gone (nothing is written then). Throws std::system_error where it
  /// cannot be written; the ring stays then. `reserve`: see create_file().
  Written write(const Metadata& about, std::uint64_t reserve = 0);

 private:
  DeadRing(std::filesystem::path folder, int lock);
  std::filesystem::path folder_;
  std::filesystem::path origin_;
  int lock_ = -1;
};

}  // namespace coop::mcap
