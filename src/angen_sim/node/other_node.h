#pragma once

namespace angen::node {

/// Throws Error where a node of this one's name runs or starts already, unless this one `replaces`
/// it: registering would end it. A node that was killed, and is still registered, does not count.
/// The name is locked until the process ends. After ros::init, before the first handle.
void require_no_other_node(bool replaces);

}  // namespace angen::node
