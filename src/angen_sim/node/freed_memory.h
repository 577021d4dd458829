#pragma once

namespace angen::node {

/// Whether the process keeps freed blocks of up to 32 MB, at most 64 MB in all, or returns them to
/// the system. A node that publishes images needs the same blocks again for each: new pages cost
/// more than the messages that are written to them.
void keep_freed_memory(bool keep);

/// All threads use one heap. Threads that find light free what others have made: with a heap each,
/// a node of lamps that come and go keeps 370 MB instead of 180.
void use_one_heap();

}  // namespace angen::node
