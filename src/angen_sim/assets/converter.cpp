#include "assets/converter.h"

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
#include <cstring>
#include <sstream>
#include <utility>

#include "core/diagnostics.h"
#include "core/plugin_path.h"
#include "core/text.h"

namespace angen::load {

namespace {

constexpr std::size_t kMaxAnswer = 384U << 20U;  // bytes: 5,000,000 triangles that share no corner

[[noreturn]] void not_started(const std::string& program, int error) {
  throw Error("cannot be read: " + program + " cannot be started (" + std::strerror(error) +
              "); build it, or reinstall Angen");
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

// Sends as much as the socket takes now; closes it when all is sent, or its reader has ended.
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

}  // namespace

std::string mesh_program() { return (own_folder() / "angen_sim/angen_mesh").string(); }

namespace {

std::string answer_of(const std::string& program, const std::vector<std::string>& words,
                      const std::string& bytes) {
  // A socket, because writing to a pipe without a reader would send a signal to this process.
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
  if (WIFEXITED(status) && WEXITSTATUS(status) == kMeshRejected)
    throw Error(printable(answer, 300));
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127) {
    throw Error("cannot be read: " + program + " does not start; build it, or reinstall Angen");
  }
  if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU) {
    throw Error("takes more than " + std::to_string(kMeshCpuSeconds) +
                " s of CPU time to read; simplify it");
  }
  throw Error("is damaged: reading it crashed " + program);
}

[[noreturn]] void not_whole() {
  throw Error("cannot be read: the answer of angen_mesh is incomplete");
}

template <class T>
T decoded(const std::string& answer) {
  try {
    T made;
    BoundedInput archive(answer);
    archive(made);
    if (archive.at_end()) return made;
  } catch (const cereal::Exception&) {
    not_whole();
  }
  not_whole();
}

bool is_whole(const MeshLook& look, std::size_t triangles) {
  if (!look.corners.empty() && look.corners.size() != triangles) return false;
  std::uint32_t least = 0;
  return std::all_of(look.parts.begin(), look.parts.end(), [&](const MeshPart& part) {
    return part.first >= std::exchange(least, part.first) && part.first <= triangles &&
           part.texture.size() <= kMaxTextureName && part.color.allFinite();
  });
}

}  // namespace

std::string convert_mesh(const std::string& program, const MeshRequest& request) {
  std::ostringstream bytes(std::ios::binary);
  cereal::BinaryOutputArchive archive(bytes);
  archive(request);
  return answer_of(program, {"mesh"}, bytes.str());
}

std::string convert_texture(const std::string& program, const std::string& bytes) {
  return answer_of(program, {"texture"}, bytes);
}

std::string convert_gray(const std::string& program, const std::string& bytes, unsigned least) {
  return answer_of(program, {"gray", std::to_string(least)}, bytes);
}

Mesh decode_mesh(const std::string& answer) {
  Mesh mesh = decoded<Mesh>(answer);
  const TriangleMesh& made = mesh.triangles;
  if (made.triangles.size() > kMaxTriangles || !is_whole(mesh.look, made.triangles.size())) {
    not_whole();
  }
  if (made.triangles.empty()) throw Error("has no triangles");
  for (const Eigen::Vector3f& vertex : made.vertices) {
    if (!vertex.allFinite()) throw Error("has a vertex that is not finite");
  }
  for (const auto& triangle : made.triangles) {
    for (const std::uint32_t corner : triangle) {
      if (corner >= made.vertices.size()) {
        throw Error("has a triangle with an unknown vertex");
      }
    }
  }
  return mesh;
}

Texture decode_texture(const std::string& answer) {
  Texture texture = decoded<Texture>(answer);
  const auto [low, high] = std::minmax(texture.width, texture.height);
  const std::size_t pixels = std::size_t{texture.width} * texture.height;
  if (low < 1 || high > kMaxTextureSide || texture.bytes.size() != 3 * pixels) not_whole();
  return texture;
}

GrayImage decode_gray(const std::string& answer) {
  GrayImage image = decoded<GrayImage>(answer);
  const auto in_range = [](double value) { return value >= 0.0 && value <= 1.0; };
  if (std::max(image.width, image.height) > kMaxPngSide ||
      image.values.size() != std::size_t{image.width} * image.height ||
      !std::all_of(image.values.begin(), image.values.end(), in_range)) {
    not_whole();
  }
  return image;
}

}  // namespace angen::load
