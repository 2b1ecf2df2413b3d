#include "launcher/keys/authority.hpp"

#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/pkcs7.h>
#include <openssl/rand.h>
#include <openssl/x509v3.h>

#include <stdexcept>
#include <string_view>

namespace coop::keys {
namespace {

constexpr long kVersion3 = 2;

struct Free {
  void operator()(BIO* bio) const { BIO_free(bio); }
  void operator()(X509* certificate) const { X509_free(certificate); }
  void operator()(X509_CRL* list) const { X509_CRL_free(list); }
  void operator()(EVP_PKEY* key) const { EVP_PKEY_free(key); }
  void operator()(PKCS7* message) const { PKCS7_free(message); }
  void operator()(ASN1_TIME* time) const { ASN1_TIME_free(time); }
  void operator()(X509_EXTENSION* extension) const { X509_EXTENSION_free(extension); }
};
template <class Object>
using Owned = std::unique_ptr<Object, Free>;

[[noreturn]] void fail(const std::string& what) {
  const unsigned long reason = ERR_get_error();
  const char* text = reason == 0 ? nullptr : ERR_reason_error_string(reason);
  throw std::runtime_error("keys: " + what + (text == nullptr ? "" : ": " + std::string(text)));
}

template <class Object>
Owned<Object> own(Object* object, const char* what) {
  if (object == nullptr) fail(what);
  return Owned<Object>(object);
}

void require(int result, const char* what) {
  if (result <= 0) fail(what);
}

Owned<BIO> reading(const std::string& text) {
  return own(BIO_new_mem_buf(text.data(), static_cast<int>(text.size())), "memory");
}

Owned<BIO> writing() {
  return own(BIO_new(BIO_s_mem()), "memory");
}

std::string text_of(const Owned<BIO>& bio) {
  char* data = nullptr;
  const long size = BIO_get_mem_data(bio.get(), &data);
  return {data, static_cast<std::size_t>(size)};
}

Owned<X509> read_certificate(const std::string& pem) {
  return own(PEM_read_bio_X509(reading(pem).get(), nullptr, nullptr, nullptr), "certificate");
}

Owned<X509_CRL> read_list(const std::string& pem) {
  return own(PEM_read_bio_X509_CRL(reading(pem).get(), nullptr, nullptr, nullptr),
             "list of revoked certificates");
}

std::string to_pem(X509* certificate) {
  const auto out = writing();
  require(PEM_write_bio_X509(out.get(), certificate), "certificate");
  return text_of(out);
}

std::string to_pem(EVP_PKEY* key) {
  const auto out = writing();
  require(PEM_write_bio_PrivateKey(out.get(), key, nullptr, nullptr, 0, nullptr, nullptr), "key");
  return text_of(out);
}

Owned<EVP_PKEY> new_key() {
  return own(EVP_EC_gen("P-256"), "key");
}

Owned<ASN1_TIME> to_asn1(Date date) {
  return own(ASN1_TIME_set(nullptr, std::chrono::system_clock::to_time_t(date)), "date");
}

void set_serial(X509* certificate) {
  std::uint64_t serial = 0;
  require(RAND_bytes(reinterpret_cast<unsigned char*>(&serial), sizeof serial), "random number");
  require(ASN1_INTEGER_set_uint64(X509_get_serialNumber(certificate), serial >> 1U), "number");
}

void add_name_part(X509_NAME* name, const char* field, const std::string& text) {
  require(X509_NAME_add_entry_by_txt(name, field, MBSTRING_UTF8,
                                     reinterpret_cast<const unsigned char*>(text.data()),
                                     static_cast<int>(text.size()), -1, 0),
          "name");
}

void add_extension(X509* certificate, int kind, const char* value) {
  const auto extension =
      own(X509V3_EXT_conf_nid(nullptr, nullptr, kind, value), "certificate's extension");
  require(X509_add_ext(certificate, extension.get(), -1), "certificate's extension");
}

/// All but issuer and signature.
Owned<X509> new_certificate(const std::string& name, EVP_PKEY* key, Date not_before,
                            Date not_after) {
  auto certificate = own(X509_new(), "certificate");
  require(X509_set_version(certificate.get(), kVersion3), "version");
  set_serial(certificate.get());
  require(X509_set1_notBefore(certificate.get(), to_asn1(not_before).get()), "date");
  require(X509_set1_notAfter(certificate.get(), to_asn1(not_after).get()), "date");
  require(X509_set_pubkey(certificate.get(), key), "key");
  X509_NAME* subject = X509_get_subject_name(certificate.get());
  add_name_part(subject, "O", "Coop");
  add_name_part(subject, "CN", name);
  return certificate;
}

}  // namespace

Authority::Authority(const std::string& name, Date not_before, Date not_after)
    : key_(new_key().release()),
      certificate_(new_certificate(name, key_.get(), not_before, not_after).release()) {
  X509* certificate = certificate_.get();
  require(X509_set_issuer_name(certificate, X509_get_subject_name(certificate)), "issuer");
  add_extension(certificate, NID_basic_constraints, "critical,CA:TRUE");
  add_extension(certificate, NID_key_usage, "critical,keyCertSign,cRLSign,digitalSignature");
  require(X509_sign(certificate, key_.get(), EVP_sha256()), "signature");
}

Authority::Authority(const Identity& kept)
    : key_(own(PEM_read_bio_PrivateKey(reading(kept.key).get(), nullptr, nullptr, nullptr), "key")
               .release()),
      certificate_(read_certificate(kept.certificate).release()) {}

Identity Authority::identity() const {
  return {to_pem(certificate_.get()), to_pem(key_.get())};
}

Identity Authority::issue(const std::string& name, Date not_before, Date not_after) const {
  const auto key = new_key();
  const auto certificate = new_certificate(name, key.get(), not_before, not_after);
  require(X509_set_issuer_name(certificate.get(), X509_get_subject_name(certificate_.get())),
          "issuer");
  add_extension(certificate.get(), NID_basic_constraints, "critical,CA:FALSE");
  add_extension(certificate.get(), NID_key_usage, "critical,digitalSignature,keyAgreement");
  require(X509_sign(certificate.get(), key_.get(), EVP_sha256()), "signature");
  return {to_pem(certificate.get()), to_pem(key.get())};
}

std::string Authority::sign(const std::string& text) const {
  constexpr int kFlags = PKCS7_TEXT | PKCS7_DETACHED;
  const auto in = reading(text);
  const auto message =
      own(PKCS7_sign(certificate_.get(), key_.get(), nullptr, in.get(), kFlags), "signature");
  require(BIO_reset(in.get()) + 1, "memory");
  const auto out = writing();
  require(SMIME_write_PKCS7(out.get(), message.get(), in.get(), kFlags), "signature");
  return text_of(out);
}

std::string Authority::revoke(const std::string& list, const std::string& certificate,
                              Date now) const {
  const auto revoked = list.empty() ? own(X509_CRL_new(), "list") : read_list(list);
  require(X509_CRL_set_version(revoked.get(), 1), "version");
  require(X509_CRL_set_issuer_name(revoked.get(), X509_get_subject_name(certificate_.get())),
          "issuer");
  require(X509_CRL_set1_lastUpdate(revoked.get(), to_asn1(now).get()), "date");
  // In force as long as the authority: a list that has run out would keep everybody out.
  require(X509_CRL_set1_nextUpdate(revoked.get(), X509_get0_notAfter(certificate_.get())), "date");
  if (!certificate.empty()) {
    X509_REVOKED* entry = X509_REVOKED_new();
    if (entry == nullptr) fail("entry");
    X509_REVOKED_set_serialNumber(entry,
                                  X509_get_serialNumber(read_certificate(certificate).get()));
    X509_REVOKED_set_revocationDate(entry, to_asn1(now).get());
    require(X509_CRL_add0_revoked(revoked.get(), entry), "entry");
  }
  X509_CRL_sort(revoked.get());
  require(X509_CRL_sign(revoked.get(), key_.get(), EVP_sha256()), "signature");
  const auto out = writing();
  require(PEM_write_bio_X509_CRL(out.get(), revoked.get()), "list");
  return text_of(out);
}

std::string subject_of(const std::string& certificate) {
  const auto read = read_certificate(certificate);
  const auto out = writing();
  X509_NAME_print_ex(out.get(), X509_get_subject_name(read.get()), 0, XN_FLAG_RFC2253);
  return text_of(out);
}

Date end_of(const std::string& certificate) {
  const auto read = read_certificate(certificate);
  std::tm parts{};
  require(ASN1_TIME_to_tm(X509_get0_notAfter(read.get()), &parts), "date");
  return std::chrono::system_clock::from_time_t(timegm(&parts));
}

bool is_revoked(const std::string& list, const std::string& certificate) {
  X509_REVOKED* entry = nullptr;
  return X509_CRL_get0_by_serial(read_list(list).get(), &entry,
                                 X509_get_serialNumber(read_certificate(certificate).get())) == 1;
}

}  // namespace coop::keys
