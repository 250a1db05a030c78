//! `--report`: what the page says of runs that are right, and of some that are not.

use super::common::Folder;
use super::common::models::WALK;
use super::folder;

/// A walk of 2000 rows, drawn from its own model.
fn drawn(name: &str) -> Folder {
    let folder = folder(name);
    folder.run("simulate walk.toml --steps 2000 --seed 4 -o drawn.csv").good();
    folder
}

/// The page about a filter of `walk.toml` over a table, and its tables' cells.
fn page(folder: &Folder, line: &str) -> String {
    folder.run(&format!("{line} --report page.html -o out.csv")).good();
    let text = folder.read("page.html");
    // a page is well formed as far as a reader of XML goes, but for its first lines
    let body = &text[text.find("<h1>").unwrap()..text.find("</html>").unwrap()];
    roxmltree::Document::parse(&format!("<html>{body}</html>")).unwrap();
    assert!(!text.contains("http://") || text.contains("http://www.w3.org/2000/svg"), "nothing is fetched");
    text
}

#[test]
fn a_run_that_is_right_is_told_so() {
    let folder = drawn("right");
    for line in
        ["filter walk.toml drawn.csv", "smooth walk.toml drawn.csv", "smooth walk.toml drawn.csv --lag 3"]
    {
        let text = page(&folder, line);
        for words in [
            "2000 rows of 1 track",
            "Yes: mean NIS is ",
            "No measure is biased",
            "none is 10 times as long",
            "<svg",
        ] {
            assert!(text.contains(words), "{line}: {words}");
        }
        assert!(!text.contains("class=\"look\""), "{line}");
    }
}

#[test]
fn noises_that_are_told_wrong_are_found() {
    let folder = drawn("noises");
    folder.write("sure.toml", &WALK.replace("std = [1]", "std = [0.3]"));
    let text = page(&folder, "filter sure.toml drawn.csv");
    assert!(
        text.contains("They are larger: mean NIS") && text.contains("its noise is told too small"),
        "{text}"
    );
    folder.write("stiff.toml", &WALK.replace("[[\"dt\"]]", "[[\"0.01*dt\"]]"));
    let text = page(&folder, "filter stiff.toml drawn.csv");
    assert!(text.contains("They are larger") && text.contains("foretells the next, with its sign"), "{text}");
    folder.write("vague.toml", &WALK.replace("std = [1]", "std = [3]").replace("[[\"dt\"]]", "[[\"9*dt\"]]"));
    let text = page(&folder, "filter vague.toml drawn.csv");
    assert!(text.contains("They are smaller") && text.contains("0.33 times as large as told"), "{text}");
}

#[test]
fn outliers_and_gaps_are_named_by_their_lines() {
    let folder = drawn("outliers");
    let text = folder.read("drawn.csv");
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let time = lines[500].split(',').next().unwrap().to_owned();
    lines[500] = format!("{time},1e4");
    // the rows of lines 801 to 900 are lost
    lines.drain(800..900);
    folder.write("holes.csv", &(lines.join("\n") + "\n"));
    let text = page(&folder, "filter walk.toml holes.csv");
    assert!(text.contains("<td>holes.csv:501</td>") && text.contains("--set gate=0.9999"), "{text}");
    assert!(
        text.contains("<td>holes.csv:800</td>") && text.contains("1 of 1899 are more than 10 times as long"),
        "{text}"
    );
    let gated = page(&folder, "filter walk.toml holes.csv --set gate=0.9999");
    assert!(gated.contains("not taken in") && gated.contains("Yes: mean NIS"), "{gated}");
}

#[test]
fn advice_is_of_what_is_wrong() {
    let folder = drawn("advice");
    // twice the noise that there is: innovations are small, and last
    folder.write("loud.toml", &WALK.replace("std = [1]", "std = [2]"));
    let text = page(&folder, "filter loud.toml drawn.csv");
    assert!(text.contains("They are smaller") && text.contains("its noise is told too large"), "{text}");
    // a gate takes the largest of a right model too, and no more is said
    let text = page(&folder, "filter walk.toml drawn.csv --set gate=0.99");
    assert!(text.contains("Yes: mean NIS"), "{text}");
    let told = folder.run("filter walk.toml drawn.csv --set gate=0.6").good().stderr;
    assert!(told.contains(", consistent: mean NIS 0."), "{told}");
    // one gross row of few
    folder.write("few.csv", "time,z\n1,0.1\n2,-0.3\n3,0.2\n4,90\n5,0.4\n6,0.1\n7,0.3\n");
    let text = page(&folder, "filter walk.toml few.csv --set gate=0.9999");
    assert!(
        text.contains("6 measured rows") || text.contains("7 measured rows to judge by are few"),
        "{text}"
    );
    // an outage whose rows are there, and empty
    let row = |k: usize| if k > 30 && k < 60 { format!("{k},\n") } else { format!("{k},0.1\n") };
    folder.write("outage.csv", &format!("time,z\n{}", (1..100).map(row).collect::<String>()));
    let text = page(&folder, "filter walk.toml outage.csv");
    assert!(text.contains("<td>outage.csv:31</td><td>30</td><td>60</td>"), "{text}");
    assert!(text.contains("29 rows without a measure"), "{text}");
    folder.write("none.csv", "time,z\n1,\n2,\n");
    let text = page(&folder, "filter walk.toml none.csv");
    assert!(text.contains("Nothing was measured") && !text.contains("class=\"good\""), "{text}");
    let found = folder.run("filter walk.toml few.csv --report r.pdf");
    assert!(found.code == 2 && found.stderr.contains("the name must end in .html"), "{}", found.stderr);
}

#[test]
fn tracks_are_judged_together_for_any_number_of_threads() {
    let folder = folder("tracks");
    folder.run("simulate walk.toml --steps 300 --runs 7 --seed 5 -o runs.csv").good();
    let one = page(&folder, "filter walk.toml runs.csv --threads 1");
    assert!(one.contains("2100 rows of 7 tracks") && one.contains("Yes: mean NIS"), "{one}");
    assert_eq!(one, page(&folder, "filter walk.toml runs.csv --threads 3"));
    assert_eq!(one, page(&folder, "filter walk.toml runs.csv --resume"));
}

#[test]
fn a_failure_stands_on_the_page() {
    let folder = folder("failure");
    let model = WALK.replace("transition = [\"x\"]", "transition = [\"x + 0*sqrt(20 - x)\"]");
    folder.write("fails.toml", &model).write("bad.csv", "time,z\n1,1\n2,100\n3,3\n");
    let found = folder.run("filter fails.toml bad.csv -o out.csv --report page.html");
    assert_eq!(found.code, 1);
    assert!(folder.read("page.html").contains("the transition of `x` is not a finite number"));
    let found = folder.run("filter walk.toml bad.csv -o out.csv --report out.csv");
    assert!(found.code == 2 && found.stderr.contains("the name must end in .html"), "{}", found.stderr);
}
