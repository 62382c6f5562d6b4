// SHA-256 (FIPS 180-4), to identify the input of a result.
#pragma once

#include <memory>
#include <string>
#include <string_view>

struct evp_md_ctx_st;  // of OpenSSL

namespace edda {

/// The hash of bytes that come piece by piece.
class Sha256 {
 public:
  Sha256();
  void add(std::string_view bytes);
  /// The hash as 64 hexadecimal digits; call once, last of all.
  std::string digits();

 private:
  struct Free {
    void operator()(evp_md_ctx_st* context) const;
  };
  std::unique_ptr<evp_md_ctx_st, Free> context_;
};

/// The hash of `bytes` as 64 hexadecimal digits.
std::string sha256(std::string_view bytes);

}  // namespace edda
