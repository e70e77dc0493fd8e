// SPDX-License-Identifier: GPL-3.0-or-later
//
// A Flamenco 3 job type: the bake that `python -m desire_path farm plan` cut into a job. Put this file into the folder
// `scripts` of the Flamenco Manager; job/flamenco.json has the settings of a job.

const JOB_TYPE = {
    label: "Desire Path Bake",
    settings: [
        {
            key: "job",
            type: "string",
            subtype: "dir_path",
            required: true,
            visible: "submission",
            description: "The folder that farm plan wrote, as all workers see it",
        },
        {
            key: "tasks",
            type: "string",
            required: true,
            visible: "submission",
            description: "Tiles of each window that have something to do, as flamenco.json in that folder says: 0,3;1;2",
        },
        {
            key: "python",
            type: "string",
            default: "python",
            visible: "submission",
            description: "A Python with desire_path on all workers",
        },
        {
            key: "memory",
            type: "string",
            default: "",
            visible: "submission",
            description: "How much memory a task may take, as 4G; empty = as much as it needs",
        },
    ],
};

function farmTask(settings, name, args) {
    const task = author.Task(name, "misc");
    const limit = settings.memory ? ["--memory", settings.memory] : [];
    const words = ["-m", "desire_path", "farm"].concat(args, limit);
    task.addCommand(author.Command("exec", { exe: settings.python, args: words }));
    return task;
}

function compileJob(job) {
    const settings = job.settings;
    let before = [];
    settings.tasks.split(";").forEach(function (tiles, window) {
        if (!/^(\d+(,\d+)*)?$/.test(tiles)) {
            throw new Error("tasks are tiles of windows, as 0,3;1;2: copy them from flamenco.json of the job");
        }
        const here = (tiles ? tiles.split(",") : []).map(function (tile) {
            const args = ["tile", settings.job, "--window", String(window), "--tile", tile];
            const task = farmTask(settings, "window-" + window + "-tile-" + tile, args);
            before.forEach(function (other) { task.addDependency(other); });
            job.addTask(task);
            return task;
        });
        before = here.length ? here : before;
    });
    const merge = farmTask(settings, "merge", ["merge", settings.job]);
    before.forEach(function (other) { merge.addDependency(other); });
    job.addTask(merge);
}
