use quadrille::study::*; use quadrille::search::Problem; use std::time::Instant;
fn main(){
 let c=quadrille::config::load(std::path::Path::new("configs/great_court.toml"),&[]).unwrap();
 let s=Study::new(&c,std::path::Path::new("configs")).unwrap();
 let mut rng=quadrille::random::stream(1,0,0);
 let mut hist=std::collections::BTreeMap::new();
 let t0=Instant::now();
 for k in 0..200 { let t=if k==0{Default::default()}else{s.random(&mut rng)};
  let a=Instant::now(); let id=s.identify(&t); let b=a.elapsed();
  let e=s.evaluate(&t); let c=a.elapsed();
  *hist.entry(e.violation.stage).or_insert(0)+=1;
  if k<30 || e.violation.stage==0 { println!("{k} {t} {} id {:?} all {:?} st {} {:.3} {} obj {:?}",id.code,b,c,e.violation.stage,e.violation.measure,e.reason,e.objectives);}
 }
 println!("{hist:?} {:?}",t0.elapsed());
}
