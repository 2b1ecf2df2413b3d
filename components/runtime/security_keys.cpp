#include "runtime/security_keys.hpp"

#include <openssl/pem.h>
#include <openssl/x509.h>
#include <openssl/x509_vfy.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "core/config/error.hpp"

namespace coop::runtime {
namespace {

template <auto kFree>
struct Free {
  template <class Object>
  void operator()(Object* object) const {
    kFree(object);
  }
};
using File = std::unique_ptr<std::FILE, Free<&std::fclose>>;
using Certificate = std::unique_ptr<X509, Free<&X509_free>>;
using RevocationList = std::unique_ptr<X509_CRL, Free<&X509_CRL_free>>;
using Key = std::unique_ptr<EVP_PKEY, Free<&EVP_PKEY_free>>;
using Store = std::unique_ptr<X509_STORE, Free<&X509_STORE_free>>;
using StoreContext = std::unique_ptr<X509_STORE_CTX, Free<&X509_STORE_CTX_free>>;

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& what) {
  throw config::Error("security: " + file.string() + ": " + what);
}

File open_file(const std::filesystem::path& file) {
  File opened(std::fopen(file.c_str(), "re"));
  if (!opened) refuse(file, std::strerror(errno));
  return opened;
}

template <auto kRead>
auto read_pem(const std::filesystem::path& file, const char* what) {
  const File opened = open_file(file);
  auto* object = kRead(opened.get(), nullptr, nullptr, nullptr);
  if (object == nullptr) refuse(file, std::string("holds no ") + what);
  return object;
}

std::string date(const ASN1_TIME* time) {
  std::tm parts{};
  char text[32] = "?";
  if (ASN1_TIME_to_tm(time, &parts) == 1) {
    std::strftime(text, sizeof text, "%Y-%m-%d %H:%M UTC", &parts);
  }
  return text;
}

void check_certificate(const KeyFiles& files, X509* certificate, std::time_t now) {
  if (X509_cmp_time(X509_get0_notAfter(certificate), &now) < 0) {
    refuse(files.certificate, "expired at " + date(X509_get0_notAfter(certificate)));
  }
  if (X509_cmp_time(X509_get0_notBefore(certificate), &now) > 0) {
    refuse(files.certificate,
           "valid from " + date(X509_get0_notBefore(certificate)) + "; is the clock right?");
  }
  const Certificate authority(read_pem<&PEM_read_X509>(files.identity_ca, "certificate"));
  const Store store(X509_STORE_new());
  X509_STORE_add_cert(store.get(), authority.get());
  std::error_code error;
  if (std::filesystem::exists(files.revoked, error)) {
    const RevocationList revoked(
        read_pem<&PEM_read_X509_CRL>(files.revoked, "list of revoked certificates"));
    X509_STORE_add_crl(store.get(), revoked.get());
    X509_STORE_set_flags(store.get(), X509_V_FLAG_CRL_CHECK);
  }
  const StoreContext context(X509_STORE_CTX_new());
  X509_STORE_CTX_init(context.get(), store.get(), certificate, nullptr);
  X509_STORE_CTX_set_time(context.get(), 0, now);
  if (X509_verify_cert(context.get()) != 1) {
    refuse(files.certificate,
           X509_verify_cert_error_string(X509_STORE_CTX_get_error(context.get())));
  }
}

}  // namespace

KeyFiles::KeyFiles(const std::filesystem::path& folder, const std::string& name)
    : identity_ca(folder / "public" / "identity_ca.pem"),
      permissions_ca(folder / "public" / "permissions_ca.pem"),
      governance(folder / "public" / "governance.p7s"),
      revoked(folder / "public" / "revoked.pem"),
      certificate(folder / name / "certificate.pem"),
      key(folder / name / "key.pem"),
      permissions(folder / name / "permissions.p7s") {}

void check_keys(const std::filesystem::path& folder, const std::string& name,
                std::chrono::system_clock::time_point now) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error)) {
    refuse(folder, "no such folder; `coop keys make` makes it");
  }
  if (!std::filesystem::exists(folder / name, error)) {
    refuse(folder / name,
           error ? error.message() : "no keys of '" + name + "'; `coop keys make` makes them");
  }
  const KeyFiles files(folder, name);
  for (const auto* file : {&files.permissions_ca, &files.governance, &files.permissions}) {
    (void)open_file(*file);
  }
  const Certificate certificate(read_pem<&PEM_read_X509>(files.certificate, "certificate"));
  const Key key(read_pem<&PEM_read_PrivateKey>(files.key, "private key"));
  check_certificate(files, certificate.get(), std::chrono::system_clock::to_time_t(now));
  if (X509_check_private_key(certificate.get(), key.get()) != 1) {
    refuse(files.key, "is not the key of " + files.certificate.string());
  }
}

DdsSettings read_dds_settings_of(const std::string& name,
                                 const std::vector<std::string>& assignments) {
  DdsSettings settings = read_dds_settings(assignments);
  if (settings.security) check_keys(settings.keys, name, std::chrono::system_clock::now());
  return settings;
}

}  // namespace coop::runtime
