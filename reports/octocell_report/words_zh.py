# SPDX-License-Identifier: MIT
"""Every text of the page in Chinese. words_en.py has the same keys."""

# ruff: noqa: E501  (sentences, not code)

from __future__ import annotations

_PAGE = {
    "language": "中文",
    "kicker": "Octocell {version} · 求出所有重叠的球对",
    "comma": "、",
    "semicolon": "；",
    "interrupted_title": "本次运行被中断。",
    "interrupted": "页面中的结果都已完整测量并核对；尚未运行的场景和规模不在其中。",
    "dirty_title": "源码有未提交的改动。",
    "dirty": "下面的提交不包含全部改动，因此这些数字无法追溯到该提交。",
    "machine": "机器",
    "cores": "{cores} 核",
    "gpu": "GPU",
    "gpu_text": "{name}，复制带宽 {copied} GB/s（读加写，本次运行中测得）",
    "compiler": "编译器",
    "instruction_set": "指令集",
    "commit": "提交",
    "commit_clean": "无改动",
    "commit_dirty": "有未提交的改动",
    "date": "日期",
    "run": "运行方式",
    "run_text": "预设 {preset}，{rounds} 轮交错测量",
    "libraries": "程序库",
    "plots_language": "图中文字为英文；术语对照见 docs/glossary.md。",
    "run_cold": "冷启动",
    "run_warm": "热运行",
    "run_rotated": "缓存失效",
    "run_graph": "图",
    "run_transfers": "含传输",
    "run_first_update": "首次更新",
    "run_update": "更新",
    "run_dynamic": "动态",
}

_TABLES = {
    "tables": "数据表",
    "tables_how": "单元格中是中位数（毫秒），其下为最快一轮到最慢一轮。每球纳秒数、候选对和存疑对取自热运行。"
    "CSV 文件中有同样的数字，未经舍入。",
    "speedups": "加速比表",
    "speedups_how": "相对于同组中该程序库最快的精确实现的倍数：在每一轮内用基线时间除以我们的时间；"
    "先列各轮的中位数，再列最低与最高的一轮。",
    "speedups_update_how": "基线更新已有的结构；我们的实现在相同的各轮中从头求出所有球对（热运行）。"
    "球并未移动，这对保持不变的结构最为有利。",
    "gpu_table": "在 GPU 上",
    "gpu_how": "热运行：场景和缓冲区都已在设备上。缓存失效：同上，但设备缓存中没有这些数据。"
    "图：各阶段预先录制，一次启动。含传输：球从主机的锁页内存传来，球对再传回去。冷启动：全部从零开始。"
    "每个时间下方是它与热运行时间之比，在每轮内计算，取中位数；大于 1 为较慢。设备字节：设备内存的最大占用，平均到每个球。",
    "column_device_bytes": "设备字节/球",
    "frames_table": "运动场景数据表",
    "frames_how": "一帧包括：所有球移动，结构随之更新或重建，然后求出所有球对。稳态：每轮取预热之后各帧的中位数，"
    "表中是各轮的中位数及其范围。首帧：第一帧在各轮中的中位数。",
    "filter": "筛选行，例如 gas fcl",
    "column_scene": "场景",
    "column_spheres": "球数",
    "column_implementation": "实现",
    "column_run_ms": "{run} [ms]",
    "column_ns": "ns/球",
    "column_candidates": "每个真实球对的候选对数",
    "column_doubts": "存疑对",
    "column_against": "对照",
    "column_median": "中位数",
    "column_range": "最低到最高的一轮",
    "column_rounds": "轮数",
    "column_motion": "运动方式",
    "column_steady": "稳态帧 [ms]",
    "column_first": "首帧 [ms]",
    "column_frames": "帧数",
    "frames_count": "{frames}，其中预热 {warmup}",
    "column_where": "位置",
    "column_runs": "运行方式",
    "column_why": "原因",
    "column_spec": "请求的写法",
    "skipped_title": "跳过的行",
    "unavailable_title": "未找到的场景",
    "skipped": "跳过",
    "cell_wrong": "错误 {losses}",
    "cell_exhibit": "反例 {losses}",
    "cell_exhibit_exact": "反例，此处精确",
}

_SECTIONS = {
    "title_correctness": "正确性",
    "how_correctness": "每一行给出的球对都与精确答案逐一核对。− 为漏掉的球对，+ 为误报的球对，× 为重复给出的球对。",
    "title_time_warm": "时间与规模，热运行",
    "how_time_warm": "热运行：从头求出所有球对，所用内存此前已被访问过。线是各轮的中位数，色带从最快一轮到最慢一轮。"
    "n^b 是在对数坐标上拟合的斜率：1 为线性，2 为平方。带叉的空心标记不精确，不画线；其漏报与误报写在下方。",
    "title_time_cold": "时间与规模，冷启动",
    "how_time_cold": "冷启动：创建、规划、分配、求解，全部从零开始。",
    "title_time_first_update": "时间与规模，首次更新",
    "how_time_first_update": "与更新相同，但取结构建成后的第一次：有些树的包围盒在首次接触时扩大，代价计在这里。",
    "title_time_update": "时间与规模，更新",
    "how_time_update": "更新：基线的结构保持不变，重新通知每个球的位置，再求所有球对。模拟程序每帧付出的就是这个代价。",
    "title_dynamic": "运动场景，逐帧时间",
    "how_dynamic": "每一帧所有球先移动，再求出所有球对：我们的实现重新构建，基线用各自的方式更新。"
    "线是各轮的中位数，色带从最快一轮到最慢一轮；灰底上的空心标记是预热帧，不计入结果。",
    "title_stages_backend": "我们的各阶段",
    "how_stages_backend": "每条为一个实现，热运行，取该场景的最大规模。被合并的阶段没有自己的一段；"
    "文字注明其时间计在哪个阶段。各场景的刻度不同。",
    "title_stages_device": "GPU 上的各阶段",
    "how_stages_device": "同上，对象是我们在设备上运行的后端；每个阶段的时间取自其流中的两个事件之间。",
    "title_bandwidth": "带宽",
    "how_bandwidth": "一个阶段至少要搬运的字节数（每个输入读一次，每个输出写一次）除以它所用的时间，"
    "取每个后端最快的精确行。虚线是在同一次运行中测得的设备内存复制带宽：除非缓存中已有所读的数据，任何阶段都不能超过它；"
    "远低于它的阶段在等待别的东西。空心的条搬运的字节太少，启动一次内核的时间更长。",
    "title_bandwidth_by_size": "带宽与规模",
    "how_bandwidth_by_size": "同上，取 gas 的所有规模。热运行时小场景留在设备缓存中，缓存失效时则不然；"
    "空心标记搬运的字节太少，启动一次内核的时间更长。",
    "title_stages_baseline": "基线的各阶段",
    "how_stages_baseline": "build 建立结构，query 向它查询所有球对。",
    "title_stages_per_sphere": "平均到每个球的各阶段时间",
    "how_stages_per_sphere": "同样的数据除以球数，每个后端使用同一刻度。",
    "title_speed_warm": "与基线比速度，热运行",
    "how_speed_warm": "各轮交错进行，比值都在同一轮内计算，因此机器状态的漂移相互抵消。"
    "对照是同组中该程序库最快的精确行，以灰字标出。",
    "title_speed_cold": "与基线比速度，冷启动",
    "how_speed_cold": "同上，全部从零开始。",
    "title_speed_first_update": "与基线比速度，首次更新",
    "how_speed_first_update": "同上，取建成后的首次更新。我们的实现从头求解（热运行）。",
    "title_speed_update": "与基线比速度，更新",
    "how_speed_update": "同上，基线的结构保持不变。我们的实现从头求解（热运行）。球并未移动，这对保持不变的结构最为有利："
    "保存球对的结构几乎无事可做。球移动时的代价见运动场景。",
    "title_memory": "内存",
    "how_memory": "常驻内存相对于场景本身的增长，减去球对输出，平均到每个球；仅指主机内存。"
    "后端在设备上占用的内存与其时间列在一起。",
}

_READING = {
    "reading": "阅读说明",
    "read_exact_title": "精确第一。",
    "read_exact": "若一行给出的球对与对同一组 float32 球作精确运算的结果完全一致，不漏、不误、不重，"
    "它就是精确的。只有精确的行才单独列出时间。",
    "read_exhibits_title": "反例",
    "read_exhibits": "是因其错误而特意保留的规则。它们漏掉什么，正是要说明的问题；它们不影响总的结论，"
    "也不主张其速度。",
    "read_runs_title": "冷启动、热运行、更新、动态。",
    "read_runs": "冷启动从零开始，包括规划和分配。热运行在已访问过的内存中从头求出所有球对。更新只有基线才有："
    "其结构保持不变，重新通知每个球的位置；建成后的首次更新单独成一种。设备上另有三种运行，见其数据表的说明。动态运行中，球逐帧移动。",
    "read_ratios_title": "比值先于时间。",
    "read_ratios": "时间只属于这台机器的那一天。交错各轮之内的比值适用范围更广，但也不是对所有机器都成立。",
    "read_candidates_title": "每个真实球对的候选对数",
    "read_candidates": "表示每找到一对要检查多少对：1 为最佳。",
    "read_doubts_title": "存疑对",
    "read_doubts": "是 float32 无法判定、须由精确运算判定的球对。",
    "read_colours_title": "颜色",
    "read_colours": "代表后端，所有图中一致；较深的色调是同一后端的变体；每个实现有自己的标记。",
}

_FINDINGS = {
    "headline_none": "没有运行任何默认行，因此什么也没有核对。",
    "headline_wrong_one": "{checked} 个默认行中有 {wrong} 个错误。",
    "headline_wrong": "{checked} 个默认行中有 {wrong} 个错误。",
    "headline_only": "唯一的默认行是精确的。",
    "headline_all": "全部 {checked} 个默认行都是精确的。",
    "rows_skipped_one": "1 行被跳过，原因见下文。",
    "rows_skipped": "{rows} 行被跳过，各行的原因见下文。",
    "excused": "{rows} 行基线因其程序库的已知缺陷而漏掉球对（{names}）。",
    "absent": "此处无法运行：{backends}。",
    "not_there": "未找到：{scenes}。",
    "exhibits": "另有 {rows} 行属于反例（{rules}），因其错误而保留",
    "exhibits_missed": "{exhibits}：它们漏掉 {share} % 的球对。",
    "exhibits_missed_none": "{exhibits}；在这里没有漏掉球对。",
    "range": "{low} 到 {high}",
    "scenes_one": "1 个场景",
    "scenes": "{scenes} 个场景",
    "won": "{name}（{scenes} 个）",
    "fastest": "在最大规模下（{scenes}），最快的精确行：{winners}。",
    "the_baselines": "基线",
    "ours": "我们的",
    "grows": "时间的增长：{slopes}。",
    "one_size": "只有一种规模，因此没有曲线：{scenes}。",
    "heaviest_one": "{stage}（{scenes} 个场景，占其时间的 {share} %）",
    "heaviest_backend": "我们最快的精确行中最耗时的阶段（{scenes}）：{stages}。",
    "heaviest_device": "设备上最快的精确行中最耗时的阶段（{scenes}）：{stages}。",
    "heaviest_baseline": "最快的基线中最耗时的阶段（{scenes}）：{stages}。",
    "per_sphere": "{name}：从 {low} ns/球（{cheap}）到 {high} ns/球（{dear}）。",
    "speed_cold": "冷启动",
    "speed_warm": "热运行",
    "speed_first_update": "首次更新（我们从头求解）",
    "speed_update": "更新（我们从头求解）",
    "speed": "{run}：我们{where}最快的精确行在 {groups} 组中的 {ahead} 组领先于 {family} 的最快者："
    "速度为其 {ratios}，中位数 {median}。",
    "where_backend": "在主机上",
    "where_device": "在 GPU 上",
    "wrong_on": "{name} 在以下场景出错：{places}。",
    "bytes": "每球字节数，精确行：{needs}。",
    "of_copy": "{name}，在 {scenes}的最大规模下，占复制带宽（{copied} GB/s）的比例：{stages}。",
    "of_no_copy": "{name}，在 {scenes}的最大规模下（未测复制带宽）：{stages}。",
    "too_little": "字节太少，无从判断（复制它们不到 {limit} µs）：{stages}。",
    "best_rate": "{name}，{run}，所有阶段合计：最高 {rate} GB/s（{place}）。",
    "best_rate_share": "{name}，{run}，所有阶段合计：最高 {rate} GB/s（{place}），为复制带宽的 {share} %。",
    "runs_by_warm": "{name}，{groups} 组中各运行时间与其热运行时间之比：{runs}。",
    "device_bytes": "{name}：每球占用 {needs} 字节设备内存。",
    "steady": "{course}：稳态帧最快的是 {name}，{time} ms。",
    "steady_speed": "{course}：我们最快的稳态帧的速度是 {family} 最快者的 {ratio}。",
}

TEXTS: dict[str, str] = _PAGE | _TABLES | _SECTIONS | _READING | _FINDINGS
