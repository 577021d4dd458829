#pragma once

namespace angen::node {

/// Whether the process keeps freed blocks of up to 32 MB, at most 64 MB in all, or returns them to
/// the system. A node that publishes images needs the same blocks again for each: new pages cost
/// more than the messages that are written to them.
void keep_freed_memory(bool keep);

}  // namespace angen::node
