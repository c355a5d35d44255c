# SPDX-License-Identifier: MIT
"""Every text of the page, in English and Chinese; say() finds one and puts the numbers in."""

# ruff: noqa: E501  (sentences, not code)

from collections.abc import Iterable
from typing import NamedTuple

from markupsafe import Markup, escape


class Said(NamedTuple):
    """The same thing in both languages."""

    en: str
    zh: str

    def __html__(self) -> str:
        """Both, each marked with its language, for the page's style to show one; once if alike."""
        if self.en == self.zh:
            return str(escape(self.en))
        parts = zip(self._fields, self, strict=True)
        return Markup("").join(Markup('<span lang="{}">{}</span>').format(*p) for p in parts)


def say(key: str, **values: object) -> Said:
    """The text of that key; a value that is Said itself goes in by language."""

    def spoken(language: int) -> str:
        known = {k: v[language] if isinstance(v, Said) else v for k, v in values.items()}
        return TEXTS[key][language].format(**known)

    return Said(spoken(0), spoken(1))


def listed(parts: Iterable[str | Said], mark: str = "comma") -> Said:
    """One after the other, with commas (or another mark) as each language writes them."""
    pairs = [part if isinstance(part, Said) else Said(part, part) for part in parts]
    english, chinese = ([pair[language] for pair in pairs] for language in (0, 1))
    return Said(TEXTS[mark][0].join(english), TEXTS[mark][1].join(chinese))


def title(name: str) -> Said:
    """Of a picture or table; pictures that differ in their run alone share one."""
    kind, _, run = name.partition("_")
    key = f"title_{name}"
    return say(key) if key in TEXTS else say(f"title_{kind}", run=say(f"run_{run}"))


def how(name: str) -> Said:
    """How to read it: what it shares with others of its kind, and what is its own."""
    keys = dict.fromkeys((f"how_{name.partition('_')[0]}", f"how_{name}"))
    return listed([say(key) for key in keys if key in TEXTS], "space")


# A text is one line or two: English, Chinese.
# fmt: off
TEXTS = {
    # The page around its sections
    "language": ("English", "中文"),
    "kicker": ("All overlapping pairs of spheres", "求出所有重叠的球对"),
    "comma": (", ", "、"),
    "space": (" ", ""),
    "dot": (" · ", " · "),
    "headline_all": ("Exact: all {checked} default rows.", "精确：全部 {checked} 个默认行。"),
    "headline_wrong": ("Wrong: {wrong} of {checked} default rows.", "错误：{checked} 个默认行中的 {wrong} 个。"),
    "headline_none": ("Nothing was checked: no default row ran.", "什么也没有核对：没有运行任何默认行。"),
    "headline_variants": ("Wrong: {wrong} of {variants} variants of the plan.",
        "错误：计划的 {variants} 个变体中的 {wrong} 个。"),
    "interrupted": ("This run was interrupted. What is here was measured and checked in full; later scenes and sizes are missing.",
        "本次运行被中断。页面中的结果都已完整测量并核对；后面的场景和规模缺失。"),
    "dirty": ("Built from changed sources: these numbers cannot be traced to the commit below.",
        "源码有未提交的改动：这些数字无法追溯到下面的提交。"),
    "fact_machine": ("Machine", "机器"),
    "fact_gpu": ("GPU", "GPU"),
    "fact_date": ("Date", "日期"),
    "fact_commit": ("Commit", "提交"),
    "fact_run": ("Run", "运行方式"),
    "fact_compiler": ("Compiler", "编译器"),
    "fact_instruction_set": ("Instruction set", "指令集"),
    "fact_libraries": ("Libraries", "程序库"),
    "machine": ("{name}: {cpu}, {cores} cores, {memory} GB, {os}", "{name}：{cpu}，{cores} 核，{memory} GB，{os}"),
    "gpu": ("{name}, copies {copied} GB/s", "{name}，复制带宽 {copied} GB/s"),
    "commit_clean": ("{commit}, clean", "{commit}，无改动"),
    "commit_dirty": ("{commit}, with changes", "{commit}，有未提交的改动"),
    "run": ("{preset}, {rounds} interleaved rounds", "{preset}，{rounds} 轮交错测量"),
    "filter": ("Filter rows, e.g. gas fcl", "筛选行，例如 gas fcl"),
    "files": ("Every picture also lies beside this page as PNG and SVG, every table in full, unrounded, as CSV.",
        "每幅图另有 PNG 和 SVG 文件，每张表另有完整、未舍入的 CSV 文件，都在本页旁边。"),
    # Captions with numbers in them
    "best": ("{who} {ns} ns per sphere", "{who} 每球 {ns} ns"),
    "best_by_ours": ("{who} {ns} ns, {ratio} times", "{who} {ns} ns，{ratio} 倍"),
    "counts": ("{exact} rows exact, {wrong} wrong, {excused} wrong by known issues of their libraries, {controls} negative controls, {skipped} skipped.",
        "{exact} 行精确，{wrong} 行错误，{excused} 行因程序库的已知缺陷而错误，{controls} 行反例，{skipped} 行跳过。"),
    "absent": ("Could not run here: {backends}.", "此处无法运行：{backends}。"),
    "origin": ("Measured on {machine}, {date}, commit {commit}, {rounds} interleaved rounds.",
        "测于 {machine}，{date}，提交 {commit}，{rounds} 轮交错测量。"),
    "origin_interrupted": ("Interrupted: scenes are missing.", "运行被中断：缺少部分场景。"),
    "left_out": ("Left out, for want of an exact planned row: {cases}.", "未列入，因为没有精确的计划行：{cases}。"),
    "regrets": ("{name}: {within} of {scenes} scenes within {target}; highest {worst} on {place}.",
        "{name}：{scenes} 个场景中有 {within} 个不超过 {target}；最高为 {place} 上的 {worst}。"),
    "claims": ("{exact} of the {rows} rows that claim to be exact are; {unsteady} rows changed their answer between runs.",
        "声称精确的 {rows} 行中有 {exact} 行精确；{unsteady} 行各次运行的结果不一致。"),
    # Runs, verdicts
    "run_cold": ("cold", "冷启动"),
    "run_warm": ("warm", "热运行"),
    "run_cold_cache": ("cold cache", "缓存失效"),
    "run_graph": ("graph", "图"),
    "run_transfers": ("with transfers", "含传输"),
    "run_first_update": ("first update", "首次更新"),
    "run_update": ("update", "更新"),
    "run_dynamic": ("dynamic", "动态"),
    "kind_wrong": ("wrong", "错误"),
    "kind_excused": ("known issue", "已知缺陷"),
    "kind_control": ("negative control", "反例"),
    "skipped": ("skipped", "跳过"),
    "verdict_within": ("within", "达标"),
    "verdict_above": ("above", "超出"),
    "verdict_unclear": ("unclear", "不确定"),
    "verdict_unknown": ("too few rounds", "轮数太少"),
    "same_plan": ("{choice} (same plan)", "{choice}（计划相同）"),
    # Sections
    "section_correctness": ("Correctness", "正确性"),
    "section_time": ("Time against size", "时间与规模"),
    "section_speed": ("Speed against the libraries", "与程序库比速度"),
    "section_moving": ("Moving scenes", "运动场景"),
    "section_stages": ("Where the time goes", "时间花在哪里"),
    "section_device": ("On the GPU", "在 GPU 上"),
    "section_memory": ("Memory", "内存"),
    "section_ablation": ("What skips are worth", "省略的价值"),
    "section_error": ("What exactness costs", "精确的代价"),
    "section_reading": ("How to read this", "阅读说明"),
    # Pictures: a title, and how to read it
    "how_front": ("Best exact row of our planner and of each library, {run}. Left: the plain scene by size; right: every scene at its largest size, with the libraries' time by ours.",
        "我们的规划器与每个程序库最快的精确行，{run}。左：普通场景随规模变化；右：各场景的最大规模，并注明程序库的时间是我们的几倍。"),
    "title_correctness": ("Wrong rows by scene", "各场景中的错误行"),
    "how_correctness": ("Each row's worst answer over sizes and runs: − pairs missed, + pairs invented, × pairs given twice.",
        "每行在各规模、各次运行中最差的结果：− 漏掉的球对，+ 误报的球对，× 重复的球对。"),
    "title_time": ("Time, {run}", "时间，{run}"),
    "how_time": ("Line: median of the rounds; band: fastest to slowest; n^b: fitted slope. Hollow marks are not exact; what they miss and invent stands in the legend.",
        "线：各轮的中位数；色带：最快到最慢；n^b：拟合的斜率。空心标记不精确，其漏报与误报写在图例中。"),
    "how_time_warm": ("Found from nothing, in memory already touched.", "从头求出，所用内存此前已被访问过。"),
    "how_time_cold": ("Create, plan, allocate and find, all from nothing.", "创建、规划、分配、求解，全部从零开始。"),
    "how_time_first_update": ("The first update after the structure was built.", "结构建成后的第一次更新。"),
    "how_time_update": ("The library's structure stands, every sphere is announced again, then all pairs are asked for.",
        "程序库的结构保持不变，重新通知每个球的位置，再求所有球对。"),
    "title_speed": ("Speed-up, {run}", "加速比，{run}"),
    "how_speed": ("How many times as fast as the library's fastest exact row (named under the axis); right of 1 ours is faster. Ratios are taken within interleaved rounds; mark and number: median; bar: lowest to highest round. Of many sizes the two largest.",
        "速度是该程序库最快精确行（名称写在坐标轴下）的几倍；大于 1 表示我们更快。各轮交错进行，比值都在同一轮内计算；标记和数字：中位数；线段：最低到最高的一轮。规模多时只列最大的两个。"),
    "how_speed_cold": ("All from nothing.", "全部从零开始。"),
    "how_speed_first_update": ("Ours finds all pairs again: its warm row.", "我们的实现从头求解：取其热运行。"),
    "how_speed_update": ("Ours finds all pairs again: its warm row. Spheres stand still, the best case of a structure that keeps its pairs.",
        "我们的实现从头求解：取其热运行。球静止不动，这对保存球对的结构最为有利。"),
    "title_dynamic": ("Frame by frame", "逐帧时间"),
    "how_dynamic": ("Each frame all spheres move, then all pairs are found. Line: median of the rounds; band: fastest to slowest. Dashed: the same row, searched again every frame. Hollow marks on grey: warm-up, which does not count.",
        "每一帧所有球先移动，再求出所有球对。线：各轮的中位数；色带：最快到最慢。虚线：同一行逐帧重新搜索。灰底上的空心标记：预热帧，不计入结果。"),
    "how_stages": ("Warm, at each scene's largest size. Bars: runs with stage marks; text: the total of runs without marks.",
        "热运行，取各场景的最大规模。色条：带阶段标记的运行；文字：不带标记的运行的总时间。"),
    "title_stages_backend": ("Our stages", "我们的各阶段"),
    "how_stages_backend": ("A fused stage has no bar; the text names the stage that holds its time.",
        "被合并的阶段没有自己的一段，文字注明其时间计在哪个阶段。"),
    "title_stages_device": ("Our stages on the GPU", "GPU 上的各阶段"),
    "how_stages_device": ("Each between two events in the device's stream.",
        "每个阶段的时间取自设备流中的两个事件之间。"),
    "title_stages_baseline": ("The libraries' stages", "程序库的各阶段"),
    "how_stages_baseline": ("Build makes the structure, query asks it for all pairs.",
        "build 建立结构，query 向它查询所有球对。"),
    "title_stages_per_sphere": ("Stages per sphere", "每球的各阶段时间"),
    "how_stages_per_sphere": ("The same by sphere, one scale for each backend.",
        "同样的数据除以球数，每个后端使用同一刻度。"),
    "title_bandwidth": ("Bandwidth", "带宽"),
    "how_bandwidth": ("The least bytes a stage must move by its time; dashed: a copy in the same memory. Hollow: so few bytes that a launch takes longer.",
        "一个阶段至少要搬运的字节数除以其时间；虚线：同一内存中的复制。空心：字节太少，启动一次内核的时间更长。"),
    "title_bandwidth_by_size": ("Bandwidth by size", "带宽与规模"),
    "how_bandwidth_by_size": ("Small scenes stay in the cache in warm runs; in those with a cold cache it holds none of them.",
        "热运行时小场景留在缓存中；冷缓存运行时缓存中没有它们。"),
    "title_memory": ("Bytes per sphere", "每球字节数"),
    "how_memory": ("Growth of the host's resident memory beyond the scene and the pairs, in a process of its own; hatched: not exact.",
        "主机常驻内存的增长，不计场景和球对输出，在独立进程中测得；斜线：不精确。"),
    "title_ablation_skips": ("Each skip forbidden alone", "逐一禁止每项省略"),
    "how_ablation_skips": ("Time without the skip by the planned time; above 1 (orange) the skip saves, below (blue) it costs. Bold: the plan takes it; grey: it does not, so nothing should change.",
        "禁止该省略后的时间与计划时间之比；大于 1（橙色）表示它节省时间，小于 1（蓝色）表示费时。粗体：计划采用；灰色：没有采用，时间应当不变。"),
    "title_ablation_steps": ("From nothing skipped to the plan", "从不省略到计划"),
    "how_ablation_steps": ("Skips allowed one after the other, all in the same rounds. Green saves, orange costs, pale is within the noise (99 % interval). A number: what the step changes, from 2 % of the start on; grey name: its plan does not take it.",
        "按固定顺序逐一允许各项省略，都在同一轮次中测量。绿色节省，橙色费时，浅色在噪声之内（99 % 区间）。数字：该步的变化，达到起点的 2 % 才注明；灰色名称：该步的计划没有采用它。"),
    "title_ablation_regret": ("Regret: the plan against the best choice", "遗憾值：计划与最佳选择"),
    "how_ablation_regret": ("Planned time by that of the fastest method or variant that can be forced, found after the fact. Mark: median of the rounds; line: 99 % interval; dashed: the target. Hollow: it came to the very same plan.",
        "计划时间除以可强制的最快方法或变体的时间，最快者是事后选出的。标记：各轮的中位数；线段：99 % 区间；虚线：目标。空心：与计划完全相同。"),
    "title_error_pareto": ("Run time against error", "运行时间与误差"),
    "how_error_pareto": ("Left is faster. Up: pairs lost, down: pairs invented, per million true pairs; on green: no error, and how rare one could still be (3/N, 95 %). Bold: worst error, median time of the scenes; pale: single scenes; dashed: the fastest that is exact.",
        "越靠左越快。向上：漏掉的球对，向下：误报的球对（每百万真实球对）；绿色：没有出错，并注明错误率的上界（3/N，95 %）。大标记：各场景中最大的错误和时间的中位数；浅色：单个场景；虚线：最快的精确者。"),
    "title_error_depth": ("How bad the worst pair is", "最严重的错误有多大"),
    "how_error_depth": ("The depth of the deepest pair lost (up) and the width of the widest gap taken for an overlap (down), by the sum of the radii.",
        "漏掉的最深重叠（向上）与误报的最宽间隔（向下），以半径之和为单位。"),
    "title_error_map": ("Errors by scene", "各场景的错误"),
    "how_error_map": ("Per million true pairs: − lost, + invented; darker: more.", "每百万真实球对：− 漏掉，+ 误报；颜色越深越多。"),
    # Tables: a title, and how to read it
    "how_best": ("Nanoseconds per sphere; below them, how many times ours.", "每球纳秒数；下方为我们的时间的倍数。"),
    "title_wrong": ("Wrong rows", "错误的行"),
    "how_wrong": ("The worst of all runs. Negative controls are rules kept because they are wrong; known issues are explained by the library.",
        "各次运行中最差的结果。反例是因其错误而特意保留的规则；已知缺陷来自程序库本身。"),
    "title_skipped": ("Skipped rows", "跳过的行"),
    "how_skipped": ("Who did not run where, and why.", "哪些实现在哪里没有运行，以及原因。"),
    "title_unavailable": ("Scenes that were not there", "未找到的场景"),
    "how_unavailable": ("Their files have to be fetched first.", "需要先获取这些场景的文件。"),
    "title_times": ("All times", "全部时间"),
    "how_times": ("Median in milliseconds, below it the fastest to the slowest round; the last three columns are of the warm run. What is not exact shows its losses.",
        "中位数（毫秒），其下为最快一轮到最慢一轮；最后三列取自热运行。不精确的行列出其漏报与误报。"),
    "title_speedups": ("Speed-ups", "加速比"),
    "how_speedups": ("Our planned rows: library's fastest time by ours within each round; median, below it the lowest to the highest round.",
        "我们的计划行：每轮内用程序库最快者的时间除以我们的时间；中位数，其下为最低到最高的一轮。"),
    "title_frames": ("Steady frames", "稳态帧"),
    "how_frames": ("Median of the frames after the warm-up; first: the first frame. Again: by the same frames, each searched from nothing.",
        "预热之后各帧的中位数；首帧：第一帧。重新搜索：与逐帧从头搜索的时间之比。"),
    "title_gpu": ("Runs on the GPU", "GPU 上的运行"),
    "how_gpu": ("Below each time its ratio to the warm run. Transfers: spheres come from the host and pairs go back. Graph: recorded once, launched as one.",
        "每个时间下方是与热运行之比。含传输：球从主机传来，球对传回。图：预先录制，一次启动。"),
    "title_regret": ("Regret in numbers", "遗憾值数据"),
    "how_regret": ("Below the regret the interval that holds 99 % of the medians of rounds drawn again. Above: all of it lies above the target; unclear: it holds the target.",
        "遗憾值下方的区间包含对各轮重新抽样所得中位数的 99 %。超出：整个区间高于目标；不确定：区间包含目标。"),
    "title_costs": ("Exact by float32", "精确与 float32 之比"),
    "how_costs": ("Time of exact by time of float32, same configuration, same rounds; 95 % interval. Deciding: stages 5 and 6, which test pairs.",
        "exact 与 f32 的时间之比，同一配置、同一轮次；95 % 区间。判定：检验球对的第 5、6 阶段。"),
    "title_rounding": ("What rounding the input did", "输入舍入的影响"),
    "how_rounding": ("These scenes come in float64; rounding them to float32, before any test of ours, changes which pairs overlap.",
        "这些场景以 float64 给出；在任何判定之前，舍入到 float32 就已改变哪些球对重叠。"),
    # Columns
    "column_scene": ("scene", "场景"),
    "column_n": ("spheres", "球数"),
    "column_label": ("implementation", "实现"),
    "column_run": ("run", "运行"),
    "column_motion": ("motion", "运动方式"),
    "column_backend": ("backend", "后端"),
    "column_ms": ("{run} [ms]", "{run} [ms]"),
    "column_ns_per_sphere": ("ns per sphere", "ns/球"),
    "column_candidates_per_pair": ("candidates per true pair", "每个真实球对的候选对数"),
    "column_uncertain_pairs": ("uncertain pairs", "存疑对"),
    "column_label_ref": ("against", "对照"),
    "column_ratios": ("times as fast", "速度倍数"),
    "column_rounds": ("rounds", "轮数"),
    "column_steady": ("steady frame [ms]", "稳态帧 [ms]"),
    "column_first": ("first [ms]", "首帧 [ms]"),
    "column_again": ("by again", "与重新搜索之比"),
    "column_frames": ("frames", "帧数"),
    "column_warmup": ("of them warm-up", "其中预热"),
    "column_device_bytes": ("device bytes per sphere", "设备字节/球"),
    "column_kind": ("kind", "类别"),
    "column_missed": ("missed", "漏掉"),
    "column_false": ("invented", "误报"),
    "column_duplicates": ("twice", "重复"),
    "column_share": ("missed [%]", "漏掉 [%]"),
    "column_where": ("where", "位置"),
    "column_runs": ("runs", "运行方式"),
    "column_reason": ("why", "原因"),
    "column_spec": ("asked for as", "请求的写法"),
    "column_planned_ms": ("planned [ms]", "计划 [ms]"),
    "column_median_ms": ("best [ms]", "最佳 [ms]"),
    "column_choice": ("best choice", "最佳选择"),
    "column_regret": ("regret", "遗憾值"),
    "column_verdict": ("verdict", "结论"),
    "column_deciding_stages": ("deciding", "判定"),
    "column_whole": ("whole", "整体"),
    "column_true_pairs": ("true pairs", "真实球对"),
    "column_title": ("scene", "场景"),
    "column_lost": ("lost by rounding", "舍入失去"),
    "column_gained": ("gained by rounding", "舍入增加"),
    "column_changed": ("changed per million", "每百万对的变化"),
    # How to read this
    "read_exact": ("Exact", "精确"),
    "tell_exact": ("The very pairs that exact arithmetic gives on the same float32 spheres: none missed, invented or given twice. Only exact rows get a bare time.",
        "给出的球对与对同一组 float32 球作精确运算的结果完全一致，不漏、不误、不重。只有精确的行才单独列出时间。"),
    "read_rows": ("Default rows", "默认行"),
    "tell_rows": ("What users get. Negative controls (rules kept because they are wrong) and variants of the plan are judged apart.",
        "用户得到的结果。反例（因其错误而保留的规则）和计划的变体另行判定。"),
    "read_ratios": ("Ratios", "比值"),
    "tell_ratios": ("Times belong to this machine on that day; ratios within interleaved rounds carry further.",
        "时间只属于这台机器的那一天；交错各轮之内的比值适用范围更广。"),
    "read_candidates": ("Candidates, uncertain pairs", "候选对、存疑对"),
    "tell_candidates": ("Candidates were looked at; uncertain pairs float32 could not decide, so that exact arithmetic had to.",
        "候选对是检查过的球对；存疑对是 float32 无法判定、须由精确运算判定的球对。"),
    "read_plots": ("Pictures", "图"),
    "tell_plots": ("Colours stand for backends, the same in all pictures; each implementation has a marker of its own.",
        "颜色代表后端，所有图中一致；每个实现有自己的标记。图中文字为英文，术语对照见 docs/glossary.md。"),
    # The README's three numbers
    "front_library": ("**{times} times** as fast as {family}'s fastest broad phase",
        "速度是 {family} 最快粗检测的 **{times} 倍**"),
    "front_libraries": ("{libraries}: {n} spheres, from nothing, in {ms} ms on one thread of {machine} (commit {commit})",
        "{libraries}：{n} 个球，从零开始，{machine} 单线程 {ms} 毫秒（提交 {commit}）"),
    "front_gpu": ("**{ms} ms** for a million spheres that lie on an {gpu} (commit {commit})",
        "球已在 {gpu} 上时，一百万个球只需 **{ms} 毫秒**（提交 {commit}）"),
    "front_owner": ("{owner} **{wrong}** of {answers}", "{owner} {answers} 次中 **{wrong}** 次"),
    "front_wrong": ("wrong answers on scenes made to break broad phases: {owners}",
        "在专为击垮粗检测而设计的场景上答错的次数：{owners}"),
}
