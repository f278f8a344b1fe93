// SPDX-License-Identifier: Apache-2.0
#include "app/doctor/private_words.h"

#include <fmt/format.h>
#include <pwd.h>
#include <stdlib.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <sstream>

#include "haptics/device_registry.h"

namespace afm::app {

namespace {

constexpr std::size_t kShortestName = 3;
constexpr std::string_view kEndsPath = " \t\n\"':,;)";

// Folders of the system, whose names reveal nothing about people.
constexpr auto kSystemFolders =
    std::to_array<std::string_view>({"/usr/", "/lib/", "/lib32/", "/lib64/", "/bin/", "/sbin/", "/etc/", "/dev/",
                                     "/proc/", "/sys/", "/boot/", "/var/lib/", "/run/user/"});

std::string lower(std::string_view text) {
  std::string small(text);
  std::transform(small.begin(), small.end(), small.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return small;
}

bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

void replace_word(std::string& text, const std::string& word, std::string_view by) {
  if (word.size() < kShortestName) return;
  const std::string wanted = lower(word);
  for (std::size_t at = lower(text).find(wanted); at != std::string::npos; at = lower(text).find(wanted, at)) {
    const std::size_t end = at + word.size();
    const bool whole = (at == 0 || !in_word(text[at - 1])) && (end == text.size() || !in_word(text[end]));
    if (whole) text.replace(at, word.size(), by);
    at += whole ? by.size() : word.size();
  }
}

void replace_all(std::string& text, std::string_view what, std::string_view by) {
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size())) {
    text.replace(at, what.size(), by);
  }
}

// Replaces /home/NAME of any user.
void replace_homes(std::string& text) {
  constexpr std::string_view kHomes = "/home/";
  for (std::size_t at = text.find(kHomes); at != std::string::npos; at = text.find(kHomes, at)) {
    const std::size_t end = text.find_first_of(std::string(kEndsPath) + "/", at + kHomes.size());
    text.replace(at, std::min(end, text.size()) - at, "~");
  }
}

bool is_system_path(std::string_view path) {
  return std::any_of(kSystemFolders.begin(), kSystemFolders.end(),
                     [&](std::string_view folder) { return path.starts_with(folder); });
}

// Short form such as ".../libHD.so"; empty for a path that may stay.
std::string shortened(std::string_view path) {
  const std::size_t name = path.find_last_of('/');
  if (name == std::string_view::npos || name == 0 || is_system_path(path)) return {};
  return fmt::format("...{}", path.substr(name));
}

// Every absolute path in the text.
void replace_serial_numbers(std::string& text) {
  constexpr std::string_view kKey = "serial ";
  for (std::size_t at = text.find(kKey); at != std::string::npos; at = text.find(kKey, at + kKey.size())) {
    std::size_t end = at + kKey.size();
    while (end < text.size() && std::isdigit(static_cast<unsigned char>(text[end])) != 0) ++end;
    if (end > at + kKey.size()) text.replace(at + kKey.size(), end - at - kKey.size(), "...");
  }
}

void shorten_paths(std::string& text) {
  for (std::size_t at = text.find('/'); at != std::string::npos; at = text.find('/', at)) {
    const std::size_t end = std::min(text.find_first_of(kEndsPath, at), text.size());
    const bool begins = at == 0 || (!in_word(text[at - 1]) && text[at - 1] != '.' && text[at - 1] != '~');
    const std::string_view path = std::string_view(text).substr(at, end - at);
    const std::string by = begins && !path.starts_with("//") ? shortened(path) : std::string();
    if (!by.empty()) text.replace(at, end - at, by);
    at = by.empty() ? end : at + by.size();
  }
}

std::string variable(const char* name) {
  const char* const value = ::secure_getenv(name);
  return value == nullptr ? "" : value;
}

void add(std::vector<std::string>& words, const std::string& word) {
  const bool known = std::find(words.begin(), words.end(), word) != words.end();
  if (!word.empty() && !known) words.push_back(word);
}

void add_person(PrivateWords& secrets, const passwd* person) {
  if (person == nullptr || person->pw_uid == 0) return;
  add(secrets.users, person->pw_name);
  add(secrets.homes, person->pw_dir);
  std::istringstream full_name(std::string(person->pw_gecos).substr(0, std::string(person->pw_gecos).find(',')));
  for (std::string word; full_name >> word;) add(secrets.users, word);
}

// Adds a computer's name, with and without its domain.
void add_host(PrivateWords& secrets, const std::string& host) {
  if (host.empty() || host == "localhost" || host == "unix" || host.front() == '/') return;
  add(secrets.hosts, host);
  add(secrets.hosts, host.substr(0, host.find('.')));
}

// True for a word of any supported maker or model.
bool is_model_word(const std::string& word) {
  const auto& kinds = haptics::device_kinds();
  return std::any_of(kinds.begin(), kinds.end(), [&](const haptics::DeviceKind& kind) {
    std::istringstream models{std::string(kind.models)};
    return std::find(std::istream_iterator<std::string>(models), {}, word) != std::istream_iterator<std::string>();
  });
}

}  // namespace

PrivateWords private_words() {
  PrivateWords secrets;
  // NOLINTBEGIN(concurrency-mt-unsafe): the command has no other thread that asks
  add_person(secrets, ::getpwuid(::getuid()));
  for (const char* name : {"SUDO_USER", "DOAS_USER", "LOGNAME", "USER"}) {
    const std::string user = variable(name);
    if (user.empty() || user == "root") continue;
    add(secrets.users, user);
    add_person(secrets, ::getpwnam(user.c_str()));
  }
  if (const passwd* const root = ::getpwuid(0); root != nullptr) add(secrets.homes, root->pw_dir);
  // NOLINTEND(concurrency-mt-unsafe)
  utsname names{};
  if (::uname(&names) == 0) add_host(secrets, names.nodename);
  const std::string display = variable("DISPLAY");
  add_host(secrets, display.substr(0, display.find_last_of(':')));
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string_view text(*entry);
    const std::size_t value = std::min(text.find('=') + 1, text.size());
    if (text.substr(value).starts_with('/')) add(secrets.paths, std::string(text.substr(value)));
  }
  // the longest first: one may contain another
  for (auto* words : {&secrets.homes, &secrets.hosts, &secrets.paths}) {
    std::sort(words->begin(), words->end(),
              [](const std::string& a, const std::string& b) { return a.size() > b.size(); });
  }
  return secrets;
}

std::string without(const PrivateWords& secrets, std::string text) {
  for (const std::string& path : secrets.paths) {
    if (const std::string by = shortened(path); !by.empty() && path.find(' ') != std::string::npos)
      replace_all(text, path, by);
  }
  for (const std::string& home : secrets.homes) {
    if (home.size() >= kShortestName) replace_all(text, home, "~");
  }
  replace_homes(text);
  shorten_paths(text);
  replace_serial_numbers(text);
  for (const std::string& user : secrets.users) replace_word(text, user, "USER");
  for (const std::string& host : secrets.hosts) replace_word(text, host, "HOST");
  return text;
}

std::string model_of(std::string_view device_name) {
  std::istringstream words(std::string(device_name.substr(0, device_name.find(", serial"))));
  std::string model;
  bool dropped = device_name.find(", serial") != std::string_view::npos;
  for (std::string word; words >> word;) {
    const bool known = is_model_word(lower(word));
    if (known) model += (model.empty() ? "" : " ") + word;
    dropped = dropped || !known;
  }
  if (!dropped) return model;
  return model + (model.empty() ? "(name left out)" : " (rest of the name left out)");
}

}  // namespace afm::app
