// What calls that must fail say.
#pragma once
#include <string>

#include "generator/sample/errors.h"

namespace lamella {

template <typename Call>
std::string message_of(Call call) {
  try {
    call();
  } catch (const DataError& error) {
    return error.what();
  }
  return "no DataError";
}

}  // namespace lamella
