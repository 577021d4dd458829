#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace angen::load {

/// The ROS packages below the folders of ROS_PACKAGE_PATH, and where their package.xml tells Gazebo
/// to search (<export><gazebo_ros gazebo_model_path="${prefix}/models"/>).
class Packages {
 public:
  explicit Packages(const std::vector<std::string>& roots);

  std::optional<std::string> folder(const std::string& package) const;
  const std::vector<std::string>& model_folders() const { return models_; }
  const std::vector<std::string>& media_folders() const { return media_; }

 private:
  void search(const std::string& folder, int depth);
  void add(const std::string& folder);

  std::map<std::string, std::string> folders_;  // by name; of two the first holds
  std::vector<std::string> models_;
  std::vector<std::string> media_;
};

}  // namespace angen::load
