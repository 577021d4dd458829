#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/element.h"
#include "core/pose.h"

namespace angen::desc {
struct Model;
struct World;
}  // namespace angen::desc

namespace angen::load {

struct Session;

/// How documents differ from those written for Angen. This class answers each question as ours
/// do: what is wrong is an error, and nothing is added.
class Dialect {
 public:
  Dialect() = default;
  virtual ~Dialect() = default;
  Dialect(const Dialect&) = delete;
  Dialect& operator=(const Dialect&) = delete;

  /// An error in a part that the rest does not need: throws it, or notes it in the session.
  virtual void report(const Error& error, Session& session) const;
  /// Calls `read`, which throws Error at an element of `roots` that it cannot read. May do so again
  /// without that element. Returns whether `read` succeeded: it does not if a root itself must be
  /// left out, as Session::set_aside then says.
  virtual bool read(const std::vector<Element*>& roots, Session& session,
                    const std::function<void()>& read) const;
  /// Whether a value that nothing can have is replaced by the nearest that is possible, with a
  /// warning.
  virtual bool corrects_values() const { return false; }
  /// Whether joints have names of their own, instead of sharing those of links and frames.
  virtual bool names_joints_apart() const { return false; }
  /// Rewrites names of a document of an SDF version (100..109) that SDF 1.9 does not permit.
  virtual void correct_names(Element&, int /*version*/, Session&) const {}
  /// Adds what a text of this dialect leaves out, and sets the customs.
  virtual void complete(desc::Model&) const {}
  virtual void complete(desc::World&) const {}
};

/// A material of Ogre's scripts, as far as it gives a color and a picture.
struct OgreMaterial {
  std::optional<Eigen::Vector4f> diffuse;
  std::string texture;  // the picture's file, "" for none
};

/// Documents made for Gazebo. They may have elements that Angen does not know; what cannot be read
/// is left out, with a warning. Documents of ours may include such ones, so each dialect needs the
/// conversions.
class GazeboDialect : public Dialect {
 public:
  /// A URDF <robot> as an <sdf> element. Lines are those of the URDF's elements of the same name.
  /// Throws Error for one that the session's dialect does not take.
  virtual Element convert_urdf(Element robot, Session& session) const = 0;
  /// The models that a <population> or <road> of a world stands for. Throws Error.
  virtual std::vector<Element> models_of(const Element& part) const = 0;
  /// The material that a <script> of a visual names, in the file or folder `path` of one of its
  /// <uri>s. A picture that is missing is a warning.
  virtual std::optional<OgreMaterial> ogre_material(const std::string& path, const Element& uri,
                                                    const Element& script,
                                                    Session& session) const = 0;
  /// What the plug-ins made for Gazebo need of their model, in a document of any dialect.
  virtual void prepare_plugins(desc::Model& model) const = 0;
};

/// The dialect of documents of ours.
const Dialect& own_dialect();
/// Documents made for Gazebo, by a library on the plug-in path that is loaded at the first call.
/// `element` is one that needs it. Throws Error that says what is missing.
const GazeboDialect& gazebo_dialect(const Element& element);

/// A static object of this type, in that library, registers its dialect.
struct GazeboRegistration {
  explicit GazeboRegistration(const GazeboDialect& dialect);
};

/// The attribute of a <world>, <model>, <include> or <actor> that says its dialect: "true" for
/// ours, "false" for Gazebo's.
constexpr char kStrict[] = "angen:strict";

/// The value of an element's kStrict, none if it has none. Throws Error for another word.
std::optional<bool> marked_strict(const Element& element);

/// Whether a library is one that robots made for Gazebo name, by its file name; ours of that name
/// has their parameters.
bool made_for_gazebo(const std::string& library);

/// True if a <plugin> below `element` is a kind of Angen's: its library is given by a path, or has
/// a catalog file on the plug-in path and is none that robots made for Gazebo name.
bool holds_own_plugin(const Element& element);

}  // namespace angen::load
