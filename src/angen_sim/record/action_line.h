#pragma once

#include "record/json_line.h"
#include "record/log.h"

namespace angen::record {

/// Writes the content of a log's line, which follows its tick.
void write_content(const LogContent& content, LineWriter& line);
/// Throws Error if the line has no action of a log.
LogContent read_content(const LineReader& line);

/// The files of a world or a model, as pairs of address and hash.
void write_files(const std::vector<LogFile>& files, LineWriter& line);
std::vector<LogFile> read_files(const LineReader& line);

}  // namespace angen::record
