#pragma once

namespace angen::node {

/// Throws Error if another simulator runs or starts in this namespace: both would publish on the
/// same topics. One of the same name may be replaced, as `replaces` says: registering ends it. A
/// node that was killed, and is still registered, does not count. The namespace is locked until the
/// process ends. After ros::init, before the first handle.
void require_no_other_node(bool replaces);

}  // namespace angen::node
