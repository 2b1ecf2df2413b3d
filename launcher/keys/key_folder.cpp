#include "launcher/keys/key_folder.hpp"

#include <sys/stat.h>

#include <algorithm>
#include <stdexcept>

#include "core/atomic_file.hpp"
#include "runtime/security_keys.hpp"

namespace coop::keys {
namespace {

using runtime::KeyFiles;

constexpr auto kAuthorityLife = std::chrono::days(3650);
/// How much longer permissions hold than the certificate, whose dates are the ones that count.
constexpr auto kMargin = std::chrono::days(1);

void make_private_folder(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::create_directories(folder.parent_path(), error);
  if (::mkdir(folder.c_str(), 0700) != 0 && !std::filesystem::is_directory(folder, error)) {
    throw std::runtime_error("keys: cannot make folder " + folder.string());
  }
  ::chmod(folder.c_str(), 0700);
}

void write_private(const std::filesystem::path& file, const std::string& text) {
  make_private_folder(file.parent_path());
  const mode_t before = ::umask(0077);
  try {
    write_file_atomically(file, text);
  } catch (...) {
    ::umask(before);
    throw;
  }
  ::umask(before);
}

/// Kept, or made where there is none.
Authority authority(const std::filesystem::path& folder, const std::string& name,
                    const std::filesystem::path& certificate, Date now) {
  const auto key = folder / "authority" / (name + ".key.pem");
  std::error_code error;
  if (std::filesystem::exists(key, error)) {
    return Authority(Identity{read_file(certificate), read_file(key)});
  }
  if (std::filesystem::exists(certificate, error)) {
    throw std::runtime_error("keys: " + key.string() +
                             " is not here: keys are made where the authority is kept");
  }
  Authority made("Coop " + name, now, now + kAuthorityLife);
  make_private_folder(folder);
  write_private(key, made.identity().key);
  write_private(certificate, made.identity().certificate);
  return made;
}

}  // namespace

KeyFolder::KeyFolder(std::filesystem::path folder, Date now)
    : folder_(std::move(folder)),
      identities_(authority(folder_, "identity_ca", KeyFiles(folder_, "").identity_ca, now)),
      permissions_(
          authority(folder_, "permissions_ca", KeyFiles(folder_, "").permissions_ca, now)) {
  const auto revoked = KeyFiles(folder_, "").revoked;
  std::error_code error;
  if (!std::filesystem::exists(revoked, error)) {
    write_private(revoked, identities_.revoke("", "", now));
  }
}

void KeyFolder::write_governance(const System& system, Protection protection) const {
  write_private(KeyFiles(folder_, "").governance,
                permissions_.sign(governance_xml(system, protection)));
}

bool KeyFolder::write_permissions(const System& system, const Participant& participant) const {
  const KeyFiles files(folder_, participant.name);
  std::error_code error;
  if (!std::filesystem::exists(files.certificate, error)) return false;
  const std::string certificate = read_file(files.certificate);
  const Date not_after = end_of(certificate);
  write_private(
      files.permissions,
      permissions_.sign(permissions_xml(
          system, participant.name, subject_of(certificate), rights_of(participant),
          std::min(not_after, std::chrono::system_clock::now()) - kMargin, not_after + kMargin)));
  return true;
}

void KeyFolder::issue(const System& system, const Participant& participant, Date not_before,
                      Date not_after) const {
  const KeyFiles files(folder_, participant.name);
  const Identity identity = identities_.issue(participant.name, not_before, not_after);
  write_private(files.key, identity.key);
  write_private(files.certificate, identity.certificate);
  (void)write_permissions(system, participant);
}

void KeyFolder::revoke(const std::string& name, Date now) const {
  const KeyFiles files(folder_, name);
  std::error_code error;
  if (!std::filesystem::exists(files.certificate, error)) {
    throw std::runtime_error("keys: no keys of '" + name + "' in " + folder_.string());
  }
  write_private(files.revoked,
                identities_.revoke(read_file(files.revoked), read_file(files.certificate), now));
  std::filesystem::remove_all(folder_ / name);
}

std::vector<KeyFolder::Entry> KeyFolder::entries() const {
  std::vector<Entry> entries;
  const std::string list = read_file(KeyFiles(folder_, "").revoked);
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    const KeyFiles files(folder_, entry.path().filename().string());
    std::error_code error;
    if (!std::filesystem::exists(files.certificate, error)) continue;
    const std::string certificate = read_file(files.certificate);
    entries.push_back({.name = entry.path().filename().string(),
                       .not_after = end_of(certificate),
                       .revoked = is_revoked(list, certificate)});
  }
  std::ranges::sort(entries, {}, &Entry::name);
  return entries;
}

}  // namespace coop::keys
