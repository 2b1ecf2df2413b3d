#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace coop {

/// Replaces the file's content as a whole or not at all: written beside it, synced, renamed; the
/// folder is created where it is missing. Throws std::system_error naming the file (disk full, no
/// permission); the old content then stands.
void write_file_atomically(const std::filesystem::path& path, std::string_view content);

/// The same for what need not outlive the machine: nothing waits for the disk. False where it
/// cannot be written; the old content then stands.
[[nodiscard]] bool replace_file(const std::filesystem::path& path, std::string_view content);

/// The whole file. Throws std::system_error naming the file.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

}  // namespace coop
