#pragma once
#include <chrono>
#include <string>
#include <vector>

namespace coop::keys {

using Date = std::chrono::system_clock::time_point;

/// Somebody who takes part in a system.
struct Participant {
  enum class Role {
    kComponent,  ///< the topics of its program, and those that concern all; the recorder hears all
    kLauncher,   ///< the topics it is named for, none of those that concern all
    kPerson,     ///< gives the commands of `coop`, hears everything
    kObserver    ///< hears everything, tells its own health
  };
  std::string name;     ///< as it joins
  std::string program;  ///< as docs/interfaces.md names it
  Role role = Role::kComponent;
  bool lockstep = false;
  bool leads_time = false;  ///< in lockstep
};

/// DDS topic names, as they are on the wire.
struct Rights {
  std::vector<std::string> publish;
  std::vector<std::string> subscribe;
};

/// What runtime/topics.hpp says of the program, and nothing else.
[[nodiscard]] Rights rights_of(const Participant& participant);

/// Where a system lives.
struct System {
  int domain = 0;
  std::string robot;  ///< the partition; empty: none
};

/// How much is protected. With each, only who has keys takes part, on its own topics.
///  - kDiscovery: who there is and which topics; data travel in the clear and could be forged.
///  - kData: data as well (AES-GCM): neither read nor forged.
///  - kAll: every message and sub-message on top.
enum class Protection { kDiscovery, kData, kAll };

/// The XML documents of DDS Security 1.1, to be signed by the permissions authority.
[[nodiscard]] std::string governance_xml(const System& system, Protection protection);
[[nodiscard]] std::string permissions_xml(const System& system, const std::string& name,
                                          const std::string& subject, const Rights& rights,
                                          Date not_before, Date not_after);

}  // namespace coop::keys
