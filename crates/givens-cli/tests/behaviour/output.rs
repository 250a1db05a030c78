//! CSV and JSON lines.

use super::common::numbers;
use super::{column, folder};

#[test]
fn csv_has_the_columns_of_the_design() {
    let folder = folder("csv");
    let cells = folder.run("filter model.toml data.csv").good().cells();
    let header = "time,x,vx,y,vy,x_std,vx_std,y_std,vy_std,nis,nis_dof,log_likelihood";
    assert_eq!(cells[0].join(","), header);
    assert_eq!(cells.len(), 6);
    assert_eq!(column(&cells, "nis_dof"), [2.0, 4.0, 1.0, 0.0, 3.0]);
    // a row without a measure has no NIS, and tells nothing
    assert_eq!((cells[4][9].as_str(), cells[4][11].as_str()), ("", "0"));
}

#[test]
fn csv_names_track_and_sensor_where_the_data_do() {
    let folder = folder("columns");
    let data = "time,sensor,track_id,range,bearing,px,py\n1,gps,7,,,30,38\n1,radar,7,50,0.9,,\n2,,7,,,,\n";
    folder.write("data.csv", data);
    let cells = folder.run("filter model.toml data.csv").good().cells();
    assert_eq!(cells[0][..3], ["time", "track_id", "sensor"]);
    let keys: Vec<String> = cells[1..].iter().map(|row| row[..3].join(",")).collect();
    assert_eq!(keys, ["1,7,gps", "1,7,radar", "2,7,"]);
}

#[test]
fn json_keys_stand_in_the_order_of_the_design() {
    let folder = folder("keys");
    let order = "time track_id sensor mean cov predicted_mean predicted_cov measures innovation innovation_cov nis \
                 nis_dof log_likelihood";
    let both = order.replace("mean cov predicted", "mean cov filtered_mean filtered_cov predicted");
    for (command, order) in [("filter", order), ("smooth", &both)] {
        let found = folder.run(&format!("{command} model.toml data.csv --format jsonl")).good();
        assert_eq!(found.stdout.lines().count(), 5);
        for line in found.stdout.lines() {
            assert_eq!(keys(line), order.split_whitespace().collect::<Vec<_>>());
        }
    }
}

/// The keys of an object without objects inside, in order.
fn keys(line: &str) -> Vec<&str> {
    let parts: Vec<&str> = line.split("\":").collect();
    parts[..parts.len() - 1].iter().map(|part| part.rsplit('"').next().unwrap()).collect()
}

#[test]
fn json_tells_null_where_there_is_none() {
    let folder = folder("null");
    let rows = folder.run("filter model.toml data.csv --format jsonl").good().objects();
    let (blank, single) = (&rows[3], &rows[2]);
    assert!(blank["track_id"].is_null() && blank["sensor"].is_null() && blank["nis"].is_null());
    assert_eq!((&blank["nis_dof"], &blank["log_likelihood"]), (&0.into(), &0.0.into()));
    for key in ["measures", "innovation", "innovation_cov"] {
        assert_eq!(blank[key].as_array().unwrap().len(), 0, "{key}");
    }
    assert_eq!(blank["mean"], blank["predicted_mean"]);
    assert_eq!(single["measures"], serde_json::json!(["bearing"]));
    assert_eq!((numbers(&single["innovation"]).len(), numbers(&single["innovation_cov"]).len()), (1, 1));
}

#[test]
fn numbers_read_back_exactly_in_both_formats() {
    let folder = folder("exact");
    let cells = folder.run("smooth model.toml data.csv").good().cells();
    let rows = folder.run("smooth model.toml data.csv --format jsonl").good().objects();
    for (k, row) in rows.iter().enumerate() {
        let (mean, cov) = (numbers(&row["mean"]), numbers(&row["cov"]));
        for (i, name) in ["x", "vx", "y", "vy"].into_iter().enumerate() {
            assert_eq!(column(&cells, name)[k].to_bits(), mean[i].to_bits());
            assert_eq!(column(&cells, &format!("{name}_std"))[k], cov[5 * i].sqrt());
        }
        assert_eq!(column(&cells, "log_likelihood")[k], numbers(&row["log_likelihood"])[0]);
    }
}

#[test]
fn small_and_large_numbers_read_back_exactly() {
    let folder = folder("sizes");
    let model = super::WALK.replace("mean = [0]", "mean = [1.2345678901234567e-300]").replace("[2]", "[0]");
    folder.write("walk.toml", &model.replace("[[\"dt\"]]", "[[\"1e300*dt\"]]"));
    folder.write("data.csv", "time,z\n0,\n1,\n");
    let found = folder.run("filter walk.toml data.csv").good().cells();
    assert_eq!(column(&found, "x"), ["1.2345678901234567e-300".parse::<f64>().unwrap(); 2]);
    assert!(found[1][1].len() < 30, "{}", found[1][1]);
    assert!((column(&found, "x_std")[1] / 1e150 - 1.0).abs() < 1e-15);
}

#[test]
fn the_format_follows_the_name_of_the_output() {
    let folder = folder("names");
    for (name, json) in [("a.csv", false), ("b.jsonl", true), ("c.ndjson", true), ("d", false)] {
        folder.run(&format!("filter model.toml data.csv -o {name}")).good();
        assert_eq!(folder.read(name).starts_with('{'), json, "{name}");
    }
    folder.run("filter model.toml data.csv -o e.csv --format jsonl").good();
    assert!(folder.read("e.csv").starts_with('{'));
}

#[test]
fn the_log_likelihood_is_each_rows_own() {
    let folder = folder("likelihood");
    let found = folder.run("filter model.toml data.csv").good();
    let total: f64 = column(&found.cells(), "log_likelihood").iter().sum();
    assert!(found.stderr.contains(&format!("5 rows, log-likelihood {total:.3}")), "{}", found.stderr);
}
