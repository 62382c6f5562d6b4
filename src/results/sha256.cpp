#include "results/sha256.hpp"

#include <fmt/format.h>
#include <openssl/crypto.h>
#include <openssl/evp.h>

#include <array>
#include <new>

namespace edda {
namespace {

/// Fetched in a context of its own, since the user's configuration of OpenSSL may lack SHA-256.
EVP_MD* algorithm() {
  static OSSL_LIB_CTX* const library = OSSL_LIB_CTX_new();
  static EVP_MD* const fetched =
      library == nullptr ? nullptr : EVP_MD_fetch(library, "SHA256", nullptr);
  return fetched;
}

}  // namespace

void Sha256::Free::operator()(evp_md_ctx_st* context) const {
  EVP_MD_CTX_free(context);
}

Sha256::Sha256() : context_(EVP_MD_CTX_new()) {
  if (context_ == nullptr || algorithm() == nullptr ||
      EVP_DigestInit_ex2(context_.get(), algorithm(), nullptr) != 1) {
    throw std::bad_alloc();
  }
}

void Sha256::add(std::string_view bytes) {
  if (EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) != 1) throw std::bad_alloc();
}

std::string Sha256::digits() {
  std::array<unsigned char, EVP_MAX_MD_SIZE> hash{};
  unsigned length = 0;
  if (EVP_DigestFinal_ex(context_.get(), hash.data(), &length) != 1) throw std::bad_alloc();
  std::string text;
  for (std::size_t k = 0; k < length; ++k) text += fmt::format("{:02x}", hash[k]);
  return text;
}

std::string sha256(std::string_view bytes) {
  Sha256 hash;
  hash.add(bytes);
  return hash.digits();
}

}  // namespace edda
