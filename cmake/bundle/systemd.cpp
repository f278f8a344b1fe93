// SPDX-License-Identifier: Apache-2.0
// The functions of libsystemd that TouchAFM calls, for the programs of the bundle (cmake/AfmBundle.cmake): systems
// without systemd lack the library, which is opened when a session bus is wanted. Without it every call fails with
// ENOSYS.
#include <dlfcn.h>
#include <systemd/sd-bus.h>

#include <cerrno>
#include <cstdarg>

namespace {

template <class Function>
Function find(Function, const char* name) {
  static void* const library = ::dlopen("libsystemd.so.0", RTLD_NOW | RTLD_LOCAL);
  return library == nullptr ? nullptr : reinterpret_cast<Function>(::dlsym(library, name));
}

}  // namespace

#define AFM_FIND(function) find(&function, #function)

int sd_bus_open_user(sd_bus** bus) {
  const auto call = AFM_FIND(sd_bus_open_user);
  return call == nullptr ? -ENOSYS : call(bus);
}

int sd_bus_set_method_call_timeout(sd_bus* bus, uint64_t usec) {
  const auto call = AFM_FIND(sd_bus_set_method_call_timeout);
  return call == nullptr ? -ENOSYS : call(bus, usec);
}

int sd_bus_call_method(sd_bus* bus, const char* destination, const char* path, const char* interface,
                       const char* member, sd_bus_error* error, sd_bus_message** reply, const char* types, ...) {
  const auto call = AFM_FIND(sd_bus_call_methodv);
  if (call == nullptr) return -ENOSYS;
  va_list arguments;
  va_start(arguments, types);
  const int result = call(bus, destination, path, interface, member, error, reply, types, arguments);
  va_end(arguments);
  return result;
}

void sd_bus_error_free(sd_bus_error* error) {
  if (const auto call = AFM_FIND(sd_bus_error_free)) call(error);
}

sd_bus* sd_bus_flush_close_unref(sd_bus* bus) {
  const auto call = AFM_FIND(sd_bus_flush_close_unref);
  return call == nullptr ? nullptr : call(bus);
}
