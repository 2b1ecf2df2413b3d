#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "launcher/keys/authority.hpp"
#include "launcher/keys/permissions.hpp"

namespace coop::keys {

/// A folder of keys: `authority/` with the two authorities' keys (belongs on no robot), `public/`
/// the same for all, NAME/ what NAME alone may read (runtime/security_keys.hpp). Folders have mode
/// 0700, files 0600. Errors are std::runtime_error, one line.
class KeyFolder {
 public:
  /// Makes the authorities where there are none yet.
  KeyFolder(std::filesystem::path folder, Date now);

  void write_governance(const System& system, Protection protection) const;
  /// Signed anew: the topics of the system may have changed. False where there are no keys for the
  /// participant to go with it.
  [[nodiscard]] bool write_permissions(const System& system, const Participant& participant) const;
  /// New keys for the participant, and permissions; those it had are good until they run out.
  void issue(const System& system, const Participant& participant, Date not_before,
             Date not_after) const;
  /// The keys it has are refused from now on, and deleted.
  void revoke(const std::string& name, Date now) const;

  struct Entry {
    std::string name;
    Date not_after;
    bool revoked = false;
  };
  /// In alphabetical order.
  [[nodiscard]] std::vector<Entry> entries() const;

 private:
  std::filesystem::path folder_;
  Authority identities_;
  Authority permissions_;
};

}  // namespace coop::keys
