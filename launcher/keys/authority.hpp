#pragma once
#include <openssl/evp.h>
#include <openssl/x509.h>

#include <chrono>
#include <memory>
#include <string>

namespace coop::keys {

using Date = std::chrono::system_clock::time_point;

/// A certificate and its key as PEM.
struct Identity {
  std::string certificate;
  std::string key;
};

/// Who vouches for others: issues identities, signs documents, revokes. Keys are elliptic curves
/// over P-256, signatures ECDSA with SHA-256. Errors are std::runtime_error.
class Authority {
 public:
  /// With a key of its own, new.
  Authority(const std::string& name, Date not_before, Date not_after);
  /// As it was kept.
  explicit Authority(const Identity& kept);

  [[nodiscard]] Identity identity() const;
  [[nodiscard]] Identity issue(const std::string& name, Date not_before, Date not_after) const;
  /// The text as S/MIME with a detached signature, as DDS Security wants its documents.
  [[nodiscard]] std::string sign(const std::string& text) const;
  /// `list` (PEM; empty: none yet) with `certificate` (PEM; empty: none) added to it.
  [[nodiscard]] std::string revoke(const std::string& list, const std::string& certificate,
                                   Date now) const;

 private:
  struct Free {
    void operator()(X509* certificate) const { X509_free(certificate); }
    void operator()(EVP_PKEY* key) const { EVP_PKEY_free(key); }
  };
  std::unique_ptr<EVP_PKEY, Free> key_;
  std::unique_ptr<X509, Free> certificate_;
};

/// "CN=amcl,O=Coop": the subject of a certificate (PEM) as permissions name it (RFC 2253).
[[nodiscard]] std::string subject_of(const std::string& certificate);
/// When the certificate (PEM) ends.
[[nodiscard]] Date end_of(const std::string& certificate);
/// Whether the list (PEM) holds the certificate (PEM).
[[nodiscard]] bool is_revoked(const std::string& list, const std::string& certificate);

}  // namespace coop::keys
