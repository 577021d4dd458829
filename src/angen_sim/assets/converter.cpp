#include "assets/converter.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "core/diagnostics.h"
#include "core/text.h"

namespace angen::load {

namespace {

constexpr std::size_t kMaxAnswer = 384U << 20U;  // bytes: 5,000,000 triangles that share no corner

[[noreturn]] void not_started(const std::string& program, int error) {
  throw Error("cannot be read: " + program + " cannot be started (" + std::strerror(error) +
              "); build it, or install Angen anew");
}

/// A file descriptor that is closed at the end.
class Descriptor {
 public:
  explicit Descriptor(int number = -1) : number_(number) {}
  ~Descriptor() { close(); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }
  void close() {
    if (number_ >= 0) ::close(number_);
    number_ = -1;
  }

 private:
  int number_;
};

pid_t start(const std::string& program, const std::vector<std::string>& words, int in, int out) {
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_adddup2(&files, in, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&files, out, STDOUT_FILENO);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addclosefrom_np(&files, STDERR_FILENO + 1);
  // No signal that this process ignores or blocks is lost on it.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  sigset_t signals;
  sigemptyset(&signals);
  posix_spawnattr_setsigmask(&attributes, &signals);
  sigfillset(&signals);
  posix_spawnattr_setsigdefault(&attributes, &signals);
  std::vector<char*> arguments = {const_cast<char*>(program.c_str())};
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);
  pid_t child = -1;
  const int error =
      posix_spawn(&child, program.c_str(), &files, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) not_started(program, error);
  return child;
}

/// A child process, which does not outlive this.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  ~Child() {
    if (id_ > 0) kill(id_, SIGKILL);
    wait();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  /// Its status; that of a success where the process lets the system forget its children.
  int wait() {
    int status = 0;
    while (id_ > 0 && waitpid(id_, &status, 0) < 0) {
      if (errno != EINTR) break;
    }
    id_ = -1;
    return status;
  }

 private:
  pid_t id_;
};

// Sends what the socket takes now; closes it when all is sent, or nobody reads any more.
void send_some(Descriptor& socket, const std::string& bytes, std::size_t& sent) {
  const ssize_t count =
      send(socket.number(), bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL | MSG_DONTWAIT);
  if (count >= 0) sent += static_cast<std::size_t>(count);
  const bool later = count < 0 && (errno == EAGAIN || errno == EINTR);
  if (sent == bytes.size() || (count < 0 && !later)) socket.close();
}

// Sends the bytes; returns all that comes until the other end is closed.
std::string exchange(Descriptor& socket, const std::string& bytes, int pipe) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point end = Clock::now() + std::chrono::seconds(kMeshWallSeconds);
  std::string answer;
  std::size_t sent = 0;
  char piece[1U << 16U];
  for (;;) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    pollfd ready[2] = {{pipe, POLLIN, 0}, {socket.number(), POLLOUT, 0}};  // -1 is left out
    const int count = left.count() > 0 ? poll(ready, 2, static_cast<int>(left.count())) : 0;
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      throw Error("takes more than " + std::to_string(kMeshWallSeconds) +
                  " s to read; simplify it");
    }
    if (ready[1].revents != 0) send_some(socket, bytes, sent);
    if (ready[0].revents == 0) continue;
    const ssize_t size = read(pipe, piece, sizeof piece);
    if (size < 0 && errno == EINTR) continue;
    if (size <= 0) return answer;
    answer.append(piece, static_cast<std::size_t>(size));
    if (answer.size() > kMaxAnswer) throw Error(kTooManyTriangles);
  }
}

std::string hex_float(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%a", value);
  return text;
}

}  // namespace

std::string mesh_program() {
  Dl_info info{};
  if (dladdr(reinterpret_cast<const void*>(&mesh_program), &info) == 0) return "angen_mesh";
  return (std::filesystem::absolute(info.dli_fname).parent_path() / "angen_sim/angen_mesh")
      .string();
}

namespace {

std::string answer_of(const std::string& program, const std::vector<std::string>& words,
                      const std::string& bytes) {
  // A socket, as writing to a pipe that nobody reads would be a signal to this process.
  int sockets[2] = {-1, -1};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) != 0) not_started(program, errno);
  Descriptor socket(sockets[0]);
  Descriptor in(sockets[1]);
  int ends[2] = {-1, -1};
  if (pipe2(ends, O_CLOEXEC) != 0) not_started(program, errno);
  const Descriptor from(ends[0]);
  Descriptor to(ends[1]);
  Child child(start(program, words, in.number(), to.number()));
  in.close();
  to.close();
  std::string answer = exchange(socket, bytes, from.number());
  const int status = child.wait();
  if (WIFEXITED(status) && WEXITSTATUS(status) == EXIT_SUCCESS) return answer;
  if (WIFEXITED(status) && WEXITSTATUS(status) == kMeshRefused) throw Error(printable(answer, 300));
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127) {
    throw Error("cannot be read: " + program + " does not start; build it, or install Angen anew");
  }
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
    throw Error("takes more than " + std::to_string(kMeshCpuSeconds) +
                " s of CPU time to read; simplify it");
  }
  throw Error("is damaged: reading it has crashed " + program);
}

/// Takes values from the front of an answer.
class Reader {
 public:
  explicit Reader(const std::string& bytes) : bytes_(bytes) {}

  template <class T>
  void take(T* to, std::size_t count) {
    if (count > (bytes_.size() - at_) / sizeof(T)) not_whole();
    if (count > 0) std::memcpy(static_cast<void*>(to), bytes_.data() + at_, count * sizeof(T));
    at_ += count * sizeof(T);
  }
  template <class T>
  void take(std::vector<T>& to, std::uint64_t count) {
    if (count > (bytes_.size() - at_) / sizeof(T)) not_whole();
    to.resize(count);
    take(to.data(), count);
  }
  void magic(const char (&wanted)[8]) {
    char found[8] = {};
    take(found, 8);
    if (std::memcmp(found, wanted, 8) != 0) not_whole();
  }
  void end() const {
    if (at_ != bytes_.size()) not_whole();
  }
  [[noreturn]] static void not_whole() {
    throw Error("cannot be read: angen_mesh gives no whole answer");
  }

 private:
  const std::string& bytes_;
  std::size_t at_ = 0;
};

void read_parts(Reader& reader, std::uint64_t count, std::size_t triangles, MeshLook& look) {
  for (std::uint64_t i = 0; i < count; ++i) {
    MeshPart part;
    std::uint32_t numbers[2] = {0, 0};
    reader.take(numbers, 2);
    reader.take(part.color.data(), 4);
    if (numbers[1] > kMaxTextureName) Reader::not_whole();
    part.first = numbers[0];
    part.texture.resize(numbers[1]);
    reader.take(part.texture.data(), numbers[1]);
    const std::uint32_t least = look.parts.empty() ? 0 : look.parts.back().first;
    if (part.first < least || part.first > triangles || !part.color.allFinite()) {
      Reader::not_whole();
    }
    look.parts.push_back(std::move(part));
  }
}

}  // namespace

std::string convert_mesh(const std::string& program, const MeshRequest& request) {
  const Vec3& scale = request.scale;
  std::vector<std::string> words = {request.extension,    hex_float(scale.x()),
                                    hex_float(scale.y()), hex_float(scale.z()),
                                    request.submesh,      request.center ? "1" : "0"};
  if (!request.materials_name.empty()) {
    words.push_back(std::to_string(request.materials.size()));
    words.push_back(request.materials_name);
  }
  return answer_of(program, words, request.bytes + request.materials);
}

std::string convert_texture(const std::string& program, const std::string& bytes) {
  return answer_of(program, {"texture"}, bytes);
}

Mesh decode_mesh(const std::string& answer) {
  Reader reader(answer);
  std::uint64_t counts[4] = {0, 0, 0, 0};
  reader.magic(kMeshMagic);
  reader.take(counts, 4);
  Mesh mesh;
  TriangleMesh& made = mesh.triangles;
  if (counts[1] > kMaxTriangles || (counts[2] != 0 && counts[2] != counts[1])) Reader::not_whole();
  reader.take(made.vertices, counts[0]);
  reader.take(made.triangles, counts[1]);
  reader.take(mesh.look.corners, counts[2]);
  read_parts(reader, counts[3], made.triangles.size(), mesh.look);
  reader.end();
  if (made.triangles.empty()) throw Error("holds no triangle");
  for (const Eigen::Vector3f& vertex : made.vertices) {
    if (!vertex.allFinite()) throw Error("has a vertex that is not finite");
  }
  for (const auto& triangle : made.triangles) {
    for (const std::uint32_t corner : triangle) {
      if (corner >= counts[0]) throw Error("has a triangle with a corner that is not there");
    }
  }
  return mesh;
}

Texture decode_texture(const std::string& answer) {
  Reader reader(answer);
  std::uint64_t size[2] = {0, 0};
  reader.magic(kTextureMagic);
  reader.take(size, 2);
  if (std::min(size[0], size[1]) < 1 || std::max(size[0], size[1]) > kMaxTextureSide) {
    Reader::not_whole();
  }
  Texture texture{static_cast<std::uint32_t>(size[0]), static_cast<std::uint32_t>(size[1]), {}};
  reader.take(texture.bytes, 3 * size[0] * size[1]);
  reader.end();
  return texture;
}

}  // namespace angen::load
