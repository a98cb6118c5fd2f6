// SPDX-License-Identifier: Apache-2.0
// FP_ADDRESS_SANITIZER is defined where the address sanitizer looks on: compilers name it
// differently.
#pragma once

#if defined(__SANITIZE_ADDRESS__)  // g++
#define FP_ADDRESS_SANITIZER
#elif defined(__has_feature)  // clang
#if __has_feature(address_sanitizer)
#define FP_ADDRESS_SANITIZER
#endif
#endif
