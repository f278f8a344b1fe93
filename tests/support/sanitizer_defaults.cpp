// SPDX-License-Identifier: Apache-2.0
// Linked into programs that use Vulkan or DDS when they are built with a sanitizer. DDS, the driver, the validation
// layer and what SDL loads are not ours to fix: their leaks are suppressed by the library's name, and ThreadSanitizer
// looks at instrumented code only (a race in our own is still reported; `race:` suppressions leave reports with the
// validation layer).

extern "C" {

const char* __lsan_default_options();
const char* __lsan_default_suppressions();
const char* __tsan_default_options();
int dlclose(void* library);

const char* __lsan_default_suppressions() {
  return "leak:libVkLayer_khronos_validation\n"
         "leak:libvulkan_lvp\n"
         "leak:libLLVM\n"
         "leak:libopenxr_loader\n"  // table of a destroyed instance, which 1.0.20 forgets
         "leak:libdbus\n"           // asked for a screen saver by SDL, if a display has a session bus
         "leak:libxcb\n";           // swapchain whose X server died; functions have no name without a symbolizer
}

// A program's last line stays its own.
const char* __lsan_default_options() { return "print_suppressions=0"; }

const char* __tsan_default_options() { return "ignore_noninstrumented_modules=1"; }

// LeakSanitizer cannot name, and so cannot suppress, what a library leaked that was unloaded before its report.
int dlclose(void* /*library*/) { return 0; }

}  // extern "C"
