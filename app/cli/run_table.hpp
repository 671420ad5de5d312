#pragma once
// What a person reads after a run.
#include <functional>
#include <span>
#include <string>

#include "app/pipeline/write_outputs.hpp"

namespace blendwright {

/// A headline and one row per seam: asked, reached, gap, angle, curvature jump and the worst place, at the
/// last stage measured; then every failed check. Sides that could not be measured are counted apart. At most
/// 80 columns unless a name is long.
[[nodiscard]] std::string run_table(const JobResult& result, const JobOutputs* outputs,
                                    const std::string& job_file);
/// 0 when verified; the code of a defect of the program comes before that of a blend that is not verified.
[[nodiscard]] int exit_code_of(const JobResult& result, const JobOutputs* outputs);
/// "wrote out/x.step (AP242, 41 kB), x.report.json": every file by its name, wrapped at 80 columns.
[[nodiscard]] std::string written_files(const JobOutputs& outputs, StepSchema schema);
/// The same with a remark on each file, unless it is empty.
[[nodiscard]] std::string written_files(std::span<const WrittenFile> files,
                                        const std::function<std::string(const WrittenFile&)>& remark);
/// "812 B", "41 kB", "1.2 MB".
[[nodiscard]] std::string size_text(std::size_t bytes);
/// The time behind the last line, or below it where it would not fit.
[[nodiscard]] std::string with_seconds(std::string text, double seconds);

}  // namespace blendwright
