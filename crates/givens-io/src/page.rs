//! A page of HTML that stands by itself: words, tables and a figure, without scripts, fonts or pictures from elsewhere.

use core::fmt::Write as _;

/// How a paragraph is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Tone {
    /// All is well.
    Good,
    /// To be looked at.
    Look,
    /// Only told.
    Plain,
}

/// A page in the making; every text is escaped.
#[derive(Clone, Debug)]
pub struct Page {
    body: String,
}

const STYLE: &str = "body{font:16px/1.5 system-ui,sans-serif;max-width:56rem;margin:2rem auto;padding:0 1rem;color:#222}\
h1{font-size:1.5rem}h2{font-size:1.15rem;margin-top:2rem}p{margin:.5rem 0}\
p.good,p.look{border-left:.4rem solid;padding:.3rem .8rem}p.good{border-color:#2a7f62}p.look{border-color:#c4511f}\
table{border-collapse:collapse;font-variant-numeric:tabular-nums}td,th{padding:.15rem .8rem;text-align:right;\
border-bottom:1px solid #ddd}td:first-child,th:first-child{text-align:left}svg{max-width:100%;height:auto}";

impl Page {
    /// A page with this title.
    pub fn new(title: &str) -> Self {
        let title = escaped(title);
        let body = format!(
            "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" content=\"width=device-width\">\n\
             <title>{title}</title>\n<style>{STYLE}</style>\n<h1>{title}</h1>\n"
        );
        Self { body }
    }

    /// A heading.
    pub fn heading(&mut self, text: &str) {
        // writing to a string cannot fail
        let _ = writeln!(self.body, "<h2>{}</h2>", escaped(text));
    }

    /// A paragraph.
    pub fn say(&mut self, tone: Tone, text: &str) {
        let class = match tone {
            Tone::Good => " class=\"good\"",
            Tone::Look => " class=\"look\"",
            Tone::Plain => "",
        };
        let _ = writeln!(self.body, "<p{class}>{}</p>", escaped(text));
    }

    /// A table; nothing if it has no rows.
    pub fn table(&mut self, header: &[&str], rows: &[Vec<String>]) {
        if rows.is_empty() {
            return;
        }
        let line = |tag: &str, cells: &mut dyn Iterator<Item = &str>| {
            let cells: Vec<String> = cells.map(|cell| format!("<{tag}>{}</{tag}>", escaped(cell))).collect();
            format!("<tr>{}</tr>\n", cells.concat())
        };
        self.body.push_str("<table>\n");
        self.body.push_str(&line("th", &mut header.iter().copied()));
        for row in rows {
            self.body.push_str(&line("td", &mut row.iter().map(String::as_str)));
        }
        self.body.push_str("</table>\n");
    }

    /// A figure, as SVG.
    pub fn figure(&mut self, svg: &str) {
        // a declaration of XML stands at the head of a file only
        let from = svg.find("<svg").unwrap_or(0);
        let _ = writeln!(self.body, "<figure>{}</figure>", svg[from..].trim_end());
    }

    /// The whole page.
    pub fn finish(mut self) -> String {
        self.body.push_str("</html>\n");
        self.body
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::{Page, Tone};

    #[test]
    fn no_text_of_a_user_becomes_markup() {
        let mut page = Page::new("<script>a & b</script>");
        page.say(Tone::Look, "x < \"y\"");
        page.table(&["<td>"], &[vec!["</table>".to_owned()]]);
        page.table(&["none"], &[]);
        page.figure("<?xml version=\"1.0\"?>\n<svg></svg>\n");
        let text = page.finish();
        assert!(text.contains("<title>&lt;script&gt;a &amp; b&lt;/script&gt;</title>"));
        assert!(text.contains("<p class=\"look\">x &lt; &quot;y&quot;</p>"));
        assert!(text.contains("<tr><th>&lt;td&gt;</th></tr>\n<tr><td>&lt;/table&gt;</td></tr>"));
        assert!(
            text.contains("<figure><svg></svg></figure>")
                && !text.contains("none")
                && !text.contains("<?xml")
        );
    }
}
