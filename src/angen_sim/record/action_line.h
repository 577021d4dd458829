#pragma once

#include "record/json_line.h"
#include "record/log.h"

namespace angen::record {

/// Writes the content of a log's line, which follows its tick.
void write_content(const LogContent& content, LineWriter& line);
/// Throws Error if the line has no action of a log.
LogContent read_content(const LineReader& line);

/// All but the format, with which a log begins.
void write_header(const LogHeader& header, LineWriter& line);
LogHeader read_header(const LineReader& line);

}  // namespace angen::record
