# SPDX-License-Identifier: MIT
"""Every text of the page in English. words_zh.py has the same keys."""

# ruff: noqa: E501  (sentences, not code)

from __future__ import annotations

_PAGE = {
    "language": "English",
    "kicker": "Octocell {version} · all overlapping pairs of spheres",
    "comma": ", ",
    "semicolon": "; ",
    "interrupted_title": "This run was interrupted.",
    "interrupted": "What is shown was measured and checked in full; scenes and sizes that would have "
    "come later are missing.",
    "dirty_title": "Built from changed sources.",
    "dirty": "The commit below does not hold all of them, so these numbers cannot be traced to it.",
    "machine": "Machine",
    "cores": "{cores} cores",
    "gpu": "GPU",
    "gpu_text": "{name}, copies {copied} GB/s (read and written, measured in this run)",
    "compiler": "Compiler",
    "instruction_set": "Instruction set",
    "commit": "Commit",
    "commit_clean": "clean",
    "commit_dirty": "dirty",
    "date": "Date",
    "run": "Run",
    "run_text": "preset {preset}, {rounds} interleaved rounds",
    "libraries": "Libraries",
    "plots_language": "",
    "run_cold": "cold",
    "run_warm": "warm",
    "run_cold_cache": "cold_cache",
    "run_graph": "graph",
    "run_transfers": "with transfers",
    "run_first_update": "first update",
    "run_update": "update",
    "run_dynamic": "dynamic",
}

_TABLES = {
    "tables": "Tables",
    "tables_how": "Median in milliseconds, below it the fastest to the slowest round. Nanoseconds "
    "per sphere, candidates and uncertain pairs are of the warm run. The same numbers, unrounded, are in the "
    "CSV files.",
    "speedups": "Speed-ups as tables",
    "speedups_how": "How many times as fast as the library's fastest exact row of that group: "
    "baseline time / our time within each round; the median over the rounds, then the lowest and the "
    "highest round.",
    "speedups_update_how": "The baseline updates its standing structure; ours finds all pairs again "
    "(its warm row) in the same rounds. The spheres have not moved, which is the best case of a structure "
    "that stands.",
    "gpu_table": "On the GPU",
    "gpu_how": "Warm: scene and buffers stand on the device. Cold cache: the same, but the device's cache "
    "holds none of it. Graph: the stages recorded once and launched as one. With transfers: the spheres "
    "come from the host's pinned memory, and the pairs go back there. Cold: everything made from "
    "nothing. Below each time its ratio to the warm time, within rounds, median; above 1 is slower. "
    "Device bytes: the most memory on the device at a time, per sphere.",
    "column_device_bytes": "device bytes/sphere",
    "frames_table": "Moving scenes as a table",
    "frames_how": "A frame is: every sphere moves, the structure follows or is rebuilt, all pairs "
    "are found. Steady: median of the frames after the warm-up, per round; shown is the median of "
    "the rounds and their range. First: the first frame, median of the rounds.",
    "filter": "Filter rows, e.g. gas fcl",
    "column_scene": "scene",
    "column_spheres": "spheres",
    "column_implementation": "implementation",
    "column_run_ms": "{run} [ms]",
    "column_ns": "ns/sphere",
    "column_candidates": "candidates per true pair",
    "column_uncertain_pairs": "uncertain pairs",
    "column_against": "against",
    "column_median": "median",
    "column_range": "lowest to highest round",
    "column_rounds": "rounds",
    "column_motion": "motion",
    "column_steady": "steady frame [ms]",
    "column_first": "first frame [ms]",
    "column_frames": "frames",
    "frames_count": "{frames}, of these {warmup} warm-up",
    "column_where": "where",
    "column_runs": "runs",
    "column_why": "why",
    "column_spec": "asked for as",
    "skipped_title": "Skipped",
    "unavailable_title": "Scenes that were not there",
    "skipped": "skipped",
    "cell_wrong": "wrong {losses}",
    "cell_negative_control": "negative control {losses}",
    "cell_negative_control_exact": "negative control, exact here",
    "regret_table": "Regret as a table",
    "regret_how": "Planned and best time are medians; the regret is the median of their ratio within "
    "rounds. The interval holds 99 % of the medians of rounds drawn again (bootstrap). Above: the whole "
    "interval lies above the target; unclear: it holds the target.",
    "regret_same_plan": "{choice} (same plan)",
    "column_backend": "backend",
    "column_planned": "planned [ms]",
    "column_best_time": "best choice [ms]",
    "column_regret": "regret",
    "column_interval": "interval",
    "column_best": "best choice",
    "column_verdict": "verdict",
    "verdict_within": "within",
    "verdict_above": "above",
    "verdict_unclear": "unclear",
    "verdict_unknown": "too few rounds",
    "costs_table": "What exactness costs, as a table",
    "costs_how": "Time of exact by time of f32, the same configuration in the same rounds; the median, and the interval "
    "that holds 95 % of the medians of rounds drawn again (bootstrap). Deciding: stages 5 and 6 alone, which test "
    "pairs. Whole: all stages.",
    "rounding_table": "What rounding the input did",
    "rounding_how": "These scenes are given in float64. Rounding them to float32, before anything of ours, changes "
    "which pairs overlap: that is no error of an overlap test, and no test can undo it.",
    "column_deciding": "deciding: exact / f32",
    "column_whole": "whole: exact / f32",
    "column_pairs": "true pairs",
    "column_lost": "lost by rounding",
    "column_gained": "gained by rounding",
    "column_changed": "changed per million",
}

_SECTIONS = {
    "title_correctness": "Correctness",
    "how_correctness": "Every row's pairs are held against the exact answer. − counts pairs "
    "missed, + pairs that are none, × pairs given more than once.",
    "title_time_warm": "Time against size, warm",
    "how_time_warm": "Warm: the pairs are found from nothing, in memory already touched. A line is "
    "the median of the rounds, its band the fastest to the slowest round. n^b is the slope fitted on "
    "the logarithms: 1 is linear, 2 is quadratic. Hollow crossed marks are not exact and get no line; "
    "what they miss and invent stands below them.",
    "title_time_cold": "Time against size, cold",
    "how_time_cold": "Cold: create, plan, allocate and find, all from nothing.",
    "title_time_first_update": "Time against size, first update",
    "how_time_first_update": "As update, but the first one after the structure was built: trees whose "
    "boxes grow on first contact pay for it here.",
    "title_time_update": "Time against size, update",
    "how_time_update": "Update: the baseline's structure stands, every sphere is announced again, "
    "then all pairs are asked for. What a simulation would pay each frame.",
    "title_dynamic": "Moving scenes, frame by frame",
    "how_dynamic": "Each frame the spheres move, then all pairs are found: ours rebuilds, or "
    "reuses what is proved to hold still; a baseline follows in its own way. A dashed line is the same row searched again in every frame. Lines are the median over the rounds, bands the fastest to the "
    "slowest round; hollow marks on grey are warm-up frames, which count for nothing.",
    "title_stages_backend": "Stages of ours",
    "how_stages_backend": "Each bar is one implementation, warm, at the scene's largest size. A fused "
    "stage has no bar of its own; the text says which stage holds its time. Scales differ from scene "
    "to scene.",
    "title_stages_device": "Stages on the GPU",
    "how_stages_device": "The same for our backends on a device, each between two events in its stream.",
    "title_bandwidth": "Bandwidth",
    "how_bandwidth": "The least bytes that a stage must move (each input read once, each output written "
    "once) by the time that it took: the fastest exact row of each backend. The dashed line is a copy in the "
    "device's memory, measured in the same run: a stage cannot do better, unless a cache holds what it "
    "reads, and one far below it waits for something else. Hollow bars move so little that a launch takes longer.",
    "title_bandwidth_by_size": "Bandwidth by size",
    "how_bandwidth_by_size": "The same over all sizes of gas. Small scenes are held by the device's cache "
    "in warm runs, not in those with a cold cache; hollow marks move so little that a launch takes longer.",
    "title_stages_baseline": "Stages of the baselines",
    "how_stages_baseline": "Build makes the structure, query asks it for all pairs.",
    "title_stages_per_sphere": "Stages per sphere",
    "how_stages_per_sphere": "The same divided by the number of spheres, on one scale for each "
    "backend.",
    "title_speed_warm": "Speed against the baselines, warm",
    "how_speed_warm": "Rounds were interleaved, so each ratio is taken within a round: drift of the "
    "machine cancels. The reference is the library's fastest exact row of that group, named in grey.",
    "title_speed_cold": "Speed against the baselines, cold",
    "how_speed_cold": "The same, all from nothing.",
    "title_speed_first_update": "Speed against the baselines, first update",
    "how_speed_first_update": "The same for the first update after building. Ours finds all pairs "
    "again, its warm row.",
    "title_speed_update": "Speed against the baselines, update",
    "how_speed_update": "The same, the baselines' structures standing. Ours finds all pairs again, its "
    "warm row. The spheres have not moved, which is the best case of a structure that stands: one that "
    "keeps its pairs has little to do. Moving scenes tell what it costs otherwise.",
    "title_memory": "Memory",
    "how_memory": "Growth of resident memory over the scene, less the pairs themselves, per sphere; "
    "of the host alone. What a backend takes on a device stands beside its times there.",
    "ablation": "Ablation and regret",
    "title_ablation_skips": "What each skip is worth",
    "how_ablation_skips": "The planner leaves out what it proves that a scene does not need. Here each skip is "
    "forbidden alone: the number is that time by the planned one, within rounds, median. Above 1 the skip "
    "saves time, below 1 it costs some. Bold: the plan takes the skip; grey: it does not, and the time should not change.",
    "title_ablation_steps": "From nothing skipped to the plan",
    "how_ablation_steps": "Skips are allowed one after the other, in one fixed order; a bar hangs between the time "
    "before and the time after. Green saves, orange costs, pale is within the noise (the 99 % interval of the "
    "difference within rounds holds 0). What a step is worth depends on those before it.",
    "title_ablation_regret": "Regret: the plan against the best choice",
    "how_ablation_regret": "Planned time by that of the fastest of all methods that can be forced and all variants, "
    "within rounds. The fastest is found after the fact, so a percent or two above 1 is chance where many "
    "are alike; hollow marks say that it came to the very same plan.",
    "error": "Run time against error",
    "title_error_pareto": "Run time against error",
    "how_error_pareto": "Each mark is one way to test a pair (colour) in one backend (shape). Up: pairs lost; down: "
    "pairs invented, both per million true pairs, logarithmic; between them, on green, what made no error, and how rare "
    "one could still be (3/N, 95 %). Left is faster. Bold is the worst error of the class at the median time of its scenes; "
    "pale marks are single scenes, and lines join backends with the same test. Warm, of each backend one configuration, the same for all tests.",
    "title_error_depth": "How bad the worst pair is",
    "how_error_depth": "The same with the worst pair's size: by how much of the sum of the radii a lost pair "
    "overlaps, and how wide the gap of an invented one is. Near 1e-7 is float32's rounding; a simulation can feel 1e-3.",
    "title_error_map": "Errors by scene",
    "how_error_map": "Per million true pairs: − lost, + invented.",
}

_READING = {
    "reading": "How to read this",
    "read_exact_title": "Exact first.",
    "read_exact": "A row is exact if it gives the very pairs that exact arithmetic gives on the same "
    "float32 spheres: none missed, none invented, none twice. Only exact rows get a bare time.",
    "read_negative_controls_title": "Negative controls",
    "read_negative_controls": "are rules kept because they are wrong. Their losses are the lesson; they do not "
    "count against the verdict, and no speed is claimed for them.",
    "read_runs_title": "Cold, warm, update, dynamic.",
    "read_runs": "Cold starts from nothing, with planning and allocation. Warm finds all pairs from "
    "nothing in memory already touched. Update exists for the baselines alone: their structure "
    "stands and every sphere is announced again; the first update after building is a run of its "
    "own. On a device there are three runs more, told at their table. In dynamic runs the spheres move, frame after frame.",
    "read_ratios_title": "Ratios before times.",
    "read_ratios": "Times belong to this machine on that day. Ratios within interleaved rounds carry "
    "further, though not to every machine.",
    "read_candidates_title": "Candidates per true pair",
    "read_candidates": "says how many pairs were looked at for each one found: 1 would be perfect.",
    "read_uncertain_pairs_title": "Uncertain pairs",
    "read_uncertain_pairs": "are pairs that float32 could not decide and exact arithmetic had to.",
    "read_colours_title": "Colours",
    "read_colours": "stand for backends, the same in all plots; darker shades are variants of one "
    "backend; each implementation has a marker of its own.",
}

# Sentences that are computed: the numbers go in.
_FINDINGS = {
    "headline_none": "No default row ran, so nothing was checked.",
    "headline_wrong_one": "{wrong} of {checked} default rows is wrong.",
    "headline_wrong": "{wrong} of {checked} default rows are wrong.",
    "headline_only": "The only default row is exact.",
    "headline_all": "All {checked} default rows are exact.",
    "rows_skipped_one": "1 row was skipped, each with its reason below.",
    "rows_skipped": "{rows} rows were skipped, each with its reason below.",
    "excused": "{rows} rows of baselines miss pairs by known issues of their libraries ({names}).",
    "absent": "Could not run here: {backends}.",
    "not_there": "Not there: {scenes}.",
    "negative_controls": "{rows} more belong to negative controls ({rules}), kept because they are wrong",
    "negative_controls_missed": "{negative_controls}: they miss {share} % of the pairs.",
    "negative_controls_missed_none": "{negative_controls}; none of them missed a pair here.",
    "range": "{low} to {high}",
    "scenes_one": "1 scene",
    "scenes": "{scenes} scenes",
    "won": "{name} on {scenes}",
    "fastest": "Fastest exact row at the largest size, of {scenes}: {winners}.",
    "the_baselines": "the baselines",
    "ours": "ours",
    "grows": "Time grows: {slopes}.",
    "one_size": "One size only, so no curve: {scenes}.",
    "heaviest_one": "{stage} in {scenes} ({share} % of its time)",
    "heaviest_backend": "Heaviest stage of our fastest exact row, of {scenes}: {stages}.",
    "heaviest_device": "Heaviest stage of the fastest exact row on a device, of {scenes}: {stages}.",
    "heaviest_baseline": "Heaviest stage of the fastest baseline, of {scenes}: {stages}.",
    "per_sphere": "{name}: {low} ns/sphere on {cheap} to {high} on {dear}.",
    "speed_cold": "Cold",
    "speed_warm": "Warm",
    "speed_first_update": "First update (ours: found again)",
    "speed_update": "Update (ours: found again)",
    "speed": "{run}, our fastest exact row{where} is ahead of {family}'s fastest in {ahead} of {groups} "
    "groups: {ratios} as fast, median {median}.",
    "where_backend": " on the host",
    "where_device": " on the GPU",
    "wrong_on": "{name} is wrong on {places}.",
    "bytes": "Bytes per sphere, exact rows: {needs}.",
    "of_copy": "{name}, at the largest sizes of {scenes}, of the bandwidth of a copy ({copied} GB/s): "
    "{stages}.",
    "of_no_copy": "{name}, at the largest sizes of {scenes}, where no copy was measured: {stages}.",
    "too_little": "Too few bytes to tell, since copying them takes less than {limit} µs: {stages}.",
    "best_rate": "{name}, {run}, over all stages: at most {rate} GB/s, on {place}.",
    "best_rate_share": "{name}, {run}, over all stages: at most {rate} GB/s, on {place}, {share} % of "
    "the bandwidth of a copy.",
    "runs_by_warm": "{name}, time by its warm time over {groups} groups: {runs}.",
    "device_bytes": "{name}: {needs} bytes of device memory per sphere.",
    "steady": "{course}: the fastest steady frame is that of {name}, {time} ms.",
    "steady_again": "{course}: {name} takes {share} of the time of the same frames searched again.",
    "steady_speed": "{course}: our fastest steady frame is {ratio} as fast as {family}'s fastest.",
    "space": " ",
    "headline_variants_one": "{wrong} of {variants} variants of the plan is wrong.",
    "headline_variants": "{wrong} of {variants} variants of the plan are wrong.",
    "origin": "Measured on {cpu}, {date}, commit {commit}, {rounds} interleaved rounds.",
    "origin_interrupted": "Measured on {cpu}, {date}, commit {commit}, {rounds} interleaved rounds; interrupted, so scenes are missing.",
    "ablation_left_out": "Left out, as there is no exact planned row to hold others against: {cases}.",
    "ablation_wrong": "Wrong answers: {cases}.",
    "skips_none": "{name}: no plan takes a skip that was forbidden here.",
    "skips_worth": "{name}: plans take {taken} skips, and forbidding one costs time in {costly} of these cases, most for {skip} on "
    "{place}: {ratio} times the planned time.",
    "skips_chance": "{name}: in {count} cases the skip is not needed, and forbidding it gives {ratios} times the planned time: so much is chance here.",
    "skips_harm": "{name}: {count} skips that plans take do harm, beyond the noise; time without them by the planned one, lowest first: {cases}.",
    "skip_on": "{skip} on {place} {value}",
    "steps_whole": "{name}: the plan is {ratios} as fast as with nothing skipped, over {scenes}; the step that saves most: {steps}.",
    "step_on_scenes": "{skip} ({scenes})",
    "steps_no_gain": "none beyond the noise",
    "steps_lost": "{name}: steps that cost time, beyond the noise: {count}, the worst in ns per sphere: {cases}.",
    "regret_within": "{name}: within {target} of the best forced choice on {within} of {scenes}; the highest regret is {worst}.",
    "regret_above": "Above {target} beyond the noise: {cases}.",
    "regret_unclear": "The interval holds {target}, so more rounds would have to tell: {cases}.",
    "regret_unknown": "Too few rounds to judge against {target}: {cases}.",
    "regret_case": "{ratio} on {place} (best: {choice})",
    "class_random": "random scenes",
    "class_structured": "structured scenes",
    "class_extreme": "extreme scenes",
    "error_class": "On {scenes} ({pairs} true pairs) these make no error: {right}; wrong are {cases}.",
    "error_class_right": "On {scenes} ({pairs} true pairs) none makes an error: {right}.",
    "error_case": "{name} ({what} on {scene})",
    "error_lost": "−{rate}",
    "error_invented": "+{rate}",
    "error_price": "{name}: deciding exactly takes {ratio} times as long as plain float32, over {scenes} ({ratios}; dearer beyond the "
    "noise on {dearer}, cheaper on {cheaper}); all stages together {whole} times.",
    "error_savings": "The cheapest test of each backend, its time by exact's, and its worst errors per million: {cases}.",
    "error_saving": "{name} {ratio} with {case}",
    "error_libraries_time": "Fastest exact broad phase by ours on the host: {cases} the time.",
    "error_library": "{name} {ratios}",
    "depth_lost": "Deepest pair lost, by the sum of the radii: {cases}.",
    "depth_invented": "Widest gap taken for an overlap: {cases}.",
    "depth_case": "{name} {value} ({scene})",
    "error_kept": "All {rows} rows that claim to be exact are, on {scenes}.",
    "error_broken": "A claim is broken: {cases}.",
    "error_libraries": "Libraries lose pairs, by their own faults: {cases}.",
    "error_unsteady": "Not the same answer in all runs: {cases}.",
    "error_more": "{count} more",
}

_FRONT = {
    "front_library": "**{times} times** as fast as {family}'s fastest broad phase",
    "front_libraries": "{libraries}: {n} spheres, from nothing, in {ms} ms on one thread of {machine} "
    "(commit {commit})",
    "front_gpu": "**{ms} ms** for a million spheres that lie on an {gpu} (commit {commit})",
    "front_owner": "{owner} **{wrong}** of {answers}",
    "front_wrong": "wrong answers on scenes made to break broad phases: {owners}",
}

TEXTS: dict[str, str] = _PAGE | _TABLES | _SECTIONS | _READING | _FINDINGS | _FRONT
