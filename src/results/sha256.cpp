#include "results/sha256.hpp"

#include <fmt/format.h>
#include <openssl/crypto.h>
#include <openssl/evp.h>

#include <array>
#include <new>

namespace edda {

std::string sha256(std::string_view bytes) {
  std::array<unsigned char, EVP_MAX_MD_SIZE> hash{};
  std::size_t length = 0;
  // In a context of its own, since the user's configuration of OpenSSL may lack SHA-256.
  static OSSL_LIB_CTX* const context = OSSL_LIB_CTX_new();
  if (context == nullptr || EVP_Q_digest(context, "SHA256", nullptr, bytes.data(), bytes.size(),
                                         hash.data(), &length) != 1) {
    throw std::bad_alloc();
  }
  std::string text;
  for (std::size_t k = 0; k < length; ++k) text += fmt::format("{:02x}", hash[k]);
  return text;
}

}  // namespace edda
