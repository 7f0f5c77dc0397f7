#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <io.h>
#include <sys/stat.h>
// clang-format off
#define WIN32_LEAN_AND_MEAN
#define PSAPI_VERSION 2
#include <windows.h>
#include <psapi.h>  // this must follow windows.h
// clang-format on

#include "core/system.hpp"

namespace remap {
namespace fs = std::filesystem;
namespace {

// Sets errno from the error of a Windows call.
void note_failure() {
  errno = errno_of(std::error_code(static_cast<int>(::GetLastError()), std::system_category()));
}

// A Handle closes itself.
class Handle {
 public:
  explicit Handle(HANDLE handle) : handle_(handle) {}
  ~Handle() {
    if (is_open()) ::CloseHandle(handle_);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;

  bool is_open() const { return handle_ != nullptr && handle_ != INVALID_HANDLE_VALUE; }
  HANDLE get() const { return handle_; }

 private:
  HANDLE handle_;
};

HANDLE handle_of(int descriptor) { return reinterpret_cast<HANDLE>(::_get_osfhandle(descriptor)); }

std::uint64_t joined(DWORD high, DWORD low) { return std::uint64_t{high} << 32 | low; }

std::optional<FileFacts> facts_of(HANDLE file) {
  const DWORD kind = ::GetFileType(file);
  if (kind == FILE_TYPE_PIPE) return FileFacts{fs::file_type::fifo, 0, {}};
  if (kind == FILE_TYPE_CHAR) return FileFacts{fs::file_type::character, 0, {}};
  BY_HANDLE_FILE_INFORMATION found{};
  if (::GetFileInformationByHandle(file, &found) == 0) {
    note_failure();
    return std::nullopt;
  }
  const bool is_folder = (found.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
  return FileFacts{is_folder ? fs::file_type::directory : fs::file_type::regular,
                   joined(found.nFileSizeHigh, found.nFileSizeLow),
                   {found.dwVolumeSerialNumber, joined(found.nFileIndexHigh, found.nFileIndexLow)}};
}

int open_by(const fs::path& path, int flags) {
  return ::_wopen(path.c_str(), flags | _O_BINARY | _O_NOINHERIT, _S_IREAD | _S_IWRITE);
}

// Limits a size to the largest that one call can read or write.
unsigned int limited(std::size_t size) {
  return static_cast<unsigned int>(std::min(size, std::size_t{1} << 30));
}

double seconds_of(const FILETIME& time) {
  return 1e-7 * static_cast<double>(joined(time.dwHighDateTime, time.dwLowDateTime));
}

}  // namespace

char32_t small_letter(char32_t letter) {
  if (letter == 0 || letter > 0xffff) return letter;
  // CharLowerW treats a pointer below 0x10000 as a character and returns its lower case.
  return static_cast<char32_t>(reinterpret_cast<std::uintptr_t>(
      ::CharLowerW(reinterpret_cast<LPWSTR>(static_cast<std::uintptr_t>(letter)))));
}

std::optional<FileFacts> facts_of(const fs::path& path) {
  constexpr DWORD kShare = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
  const Handle file(::CreateFileW(path.c_str(), 0, kShare, nullptr, OPEN_EXISTING, FILE_FLAG_BACKUP_SEMANTICS,
                                  nullptr));  // this flag opens folders, too
  if (file.is_open()) return facts_of(file.get());
  note_failure();
  return std::nullopt;
}

std::optional<FileFacts> facts_of(int descriptor) { return facts_of(handle_of(descriptor)); }

int open_to_read(const fs::path& path) { return open_by(path, _O_RDONLY); }

void wait_for_writers(int) {}

std::ptrdiff_t read_at(int descriptor, std::uintmax_t place, char* bytes, std::size_t size) {
  OVERLAPPED from{};
  from.Offset = static_cast<DWORD>(place);
  from.OffsetHigh = static_cast<DWORD>(place >> 32);
  DWORD count = 0;
  if (::ReadFile(handle_of(descriptor), bytes, limited(size), &count, &from) != 0) return count;
  if (::GetLastError() == ERROR_HANDLE_EOF) return 0;
  note_failure();
  return -1;
}

std::ptrdiff_t read_on(int descriptor, char* bytes, std::size_t size) {
  return ::_read(descriptor, bytes, limited(size));
}

std::FILE* create_file(const fs::path& path) {
  const int file = open_by(path, _O_RDWR | _O_CREAT | _O_EXCL);
  return file < 0 ? nullptr : ::_fdopen(file, "w+b");
}

int descriptor_of(std::FILE* stream) { return ::_fileno(stream); }

// No further checks are needed. Only administrators can make links on Windows, and the rights of a folder
// decide who owns its files.
int open_own_file(const fs::path& folder, const fs::path& below, OwnFile use) {
  return open_by(folder / below, use == OwnFile::kRead ? _O_RDONLY : _O_WRONLY | _O_CREAT | _O_APPEND);
}

bool append_to_file(int descriptor, std::string_view text) {
  return ::_write(descriptor, text.data(), limited(text.size())) == std::ssize(text) &&
         wait_for_disk(descriptor);
}

bool wait_for_disk(int descriptor) { return ::_commit(descriptor) == 0; }

// Folders and read-only files cannot be opened here, so it does not wait for them.
bool wait_for_disk(const fs::path& path) {
  const OpenFile file(open_by(path, _O_RDWR));
  return !file.is_open() || wait_for_disk(file.get());
}

bool create_scratch_folder(std::string& name) {
  for (unsigned int number = static_cast<unsigned int>(own_process()), tries = 0; tries < 1000;
       ++number, ++tries) {
    const std::string digits = std::to_string(1000000 + number % 1000000).substr(1);
    name.replace(name.size() - digits.size(), digits.size(), digits);
    std::error_code failure;
    if (fs::create_directory(name, failure)) return true;
    errno = failure ? errno_of(failure) : EEXIST;
    if (failure) return false;
  }
  return false;
}

// All processes that use the folder have the same name for the lock.
FolderLock::FolderLock(const fs::path& folder) {
  std::error_code ignored;
  const std::size_t hash = std::hash<std::wstring>()(fs::weakly_canonical(folder, ignored).wstring());
  const std::wstring name = L"Global\\remap-" + std::to_wstring(hash);
  const HANDLE lock = ::CreateMutexW(nullptr, FALSE, name.c_str());
  constexpr DWORD kMinute = 60'000;
  is_held_ = lock == nullptr || ::WaitForSingleObject(lock, kMinute) != WAIT_TIMEOUT;
  handle_ = reinterpret_cast<std::intptr_t>(lock);
}

FolderLock::~FolderLock() {
  const Handle lock(reinterpret_cast<HANDLE>(handle_));
  if (lock.is_open() && is_held_) ::ReleaseMutex(lock.get());
}

int own_process() { return static_cast<int>(::GetCurrentProcessId()); }

bool has_ended(int process) {
  const Handle other(::OpenProcess(SYNCHRONIZE, FALSE, static_cast<DWORD>(process)));
  if (other.is_open()) return ::WaitForSingleObject(other.get(), 0) == WAIT_OBJECT_0;
  return ::GetLastError() == ERROR_INVALID_PARAMETER;
}

std::string machine_name() {
  std::array<char, MAX_COMPUTERNAME_LENGTH + 1> name{};
  DWORD size = static_cast<DWORD>(name.size());
  return ::GetComputerNameA(name.data(), &size) != 0 ? name.data() : "";
}

std::uint64_t memory_size() {
  MEMORYSTATUSEX status{};
  status.dwLength = sizeof status;
  return ::GlobalMemoryStatusEx(&status) != 0 ? status.ullTotalPhys : 0;
}

fs::path program_file() {
  std::array<wchar_t, 1 << 15> name{};
  const DWORD size = ::GetModuleFileNameW(nullptr, name.data(), static_cast<DWORD>(name.size()));
  return size < name.size() ? fs::path(name.data()) : fs::path();
}

void raise_limit_of_open_files() { ::_setmaxstdio(2048); }

void fail_at_limit_of_file_size() {}

// Windows itself handles the second signal.
void watch_signals(void (*note)(int)) {
  for (const int signal : {SIGINT, SIGTERM, SIGBREAK}) std::signal(signal, note);
}

// Windows makes no copies of processes.
std::optional<ProcessCopy> copy_process(const std::function<void(int)>&) { return std::nullopt; }
std::string end_of(const ProcessCopy&) { return ""; }
void interrupt(const ProcessCopy&) {}
bool send_all(int, const std::string&) { return false; }
std::vector<bool> wait_to_read(const std::vector<int>&) { return {}; }

ResourceUse resource_use() noexcept {
  FILETIME begin{}, end{}, kernel{}, user{};
  PROCESS_MEMORY_COUNTERS memory{};
  if (::GetProcessTimes(::GetCurrentProcess(), &begin, &end, &kernel, &user) == 0 ||
      ::GetProcessMemoryInfo(::GetCurrentProcess(), &memory, sizeof memory) == 0)
    return {};
  return {seconds_of(kernel) + seconds_of(user), memory.PeakWorkingSetSize};
}

}  // namespace remap
