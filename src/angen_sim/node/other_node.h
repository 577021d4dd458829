#pragma once

namespace angen::node {

/// Throws Error where a node of this one's name runs already: registering would end it. A node that
/// was killed, and is still registered, does not count. After ros::init, before the first handle.
void require_no_other_node();

}  // namespace angen::node
